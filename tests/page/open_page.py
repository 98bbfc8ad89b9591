"""Opens a page in headless Chromium, from a file: it comes up without a message on the console, is a page of at most
6 MB for the default drape, and draws the body. WebGL is done in software."""
import html
import json
import os
import re
import shutil
import subprocess
import sys

program, scratch, browser = os.path.abspath(sys.argv[1]), sys.argv[2], sys.argv[3]
if not os.path.exists(browser):
    print("skipped: no Chromium here (Debian: chromium)")
    sys.exit(0)
shutil.rmtree(scratch, ignore_errors=True)
os.makedirs(scratch)
os.chdir(scratch)
subprocess.run([program, "drape", "--keep", "121", "-o", "d.glb", "--no-picture", "--html", "d.html", "-q"], check=True)
failures = []
size = os.path.getsize("d.html")
if size > 6e6: failures.append(f"the page of the default drape has {size} bytes")


def open_page(*options, page="d.html"):
    return subprocess.run(
        [browser, "--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
         "--window-size=1280,800", "--enable-logging=stderr", "--user-data-dir=" + os.path.abspath("profile"),
         "--virtual-time-budget=4000", *options, "file://" + os.path.abspath(page)],
        capture_output=True, text=True, timeout=200)


shown = open_page("--dump-dom")
console = [line for line in shown.stderr.splitlines() if "CONSOLE" in line]
if console: failures.append("console: " + "; ".join(console))
if 'data-ready="yes"' not in shown.stdout:
    if "has no WebGL" in shown.stdout and not failures:
        print("skipped: this Chromium has no WebGL, not even in software")
        sys.exit(0)
    failures.append("the page is not ready")
# What stands on the page: a tree of checkboxes, charts, the worst frame, downloads, and a still that needs no script.
for name in ["skin", "ellipsoids", "proxy's surface", "cloth", "landmarks"]:
    if not re.search(f'<label><input type="checkbox"> {name}<', shown.stdout): failures.append(f"no checkbox for {name}")
parts = re.search(r'<details id="parts">(.*?)</details>', shown.stdout, re.S)
if not parts or parts[1].count('type="checkbox"') != 15: failures.append("no checkbox for each of 15 parts")
if '<div id="still"><svg' not in open("d.html").read(): failures.append("no still for the first paint")
for file in ["report.json", "errors.csv", "frames.csv"]:
    if f'download="{file}"' not in shown.stdout: failures.append(f"no {file} to download")
for pattern, what in [(r'<output id="now">[0-9.]+ s<', "the time"), (r'<span id="most">\+[0-9.]+ mm<', "the legend"),
                      (r'<div id="stages" class="bars"><div title="[0-9]+ % of [0-9]+ ms, begins at [0-9.]+ ms', "the times of stages"),
                      (r'<summary>all [0-9]+ tasks on [0-9]+ thread', "the timeline of tasks")]:
    if not re.search(pattern, shown.stdout): failures.append(f"the page lacks {what}")
open_page("--screenshot=" + os.path.abspath("d.png"))
# A picture without the body compresses to a fraction of this.
if not os.path.exists("d.png") or os.path.getsize("d.png") < 60000: failures.append("the body is not drawn")
# A page of a proxy alone, a page of files, and a page with warnings come up as well, each without a word on the console.
made = [["fit", "--tier", "solid", "-o", "p.bodice", "--glb", "p.glb", "-q"], ["report", "p.bodice", "-o", "proxy.html", "-q"],
        ["report", "p.glb", "-o", "scene.html", "-q"],
        ["drape", "--vertices", "3000", "--tier", "solid", "--motion", "walk", "--frames", "8", "--substeps", "4", "-o", "w.glb",
         "--no-picture", "--html", "walk.html", "-q"]]
for command in made: subprocess.run([program, *command], check=True)
for page in ["proxy.html", "scene.html", "walk.html"]:
    shown = open_page("--dump-dom", page=page)
    console = [line for line in shown.stderr.splitlines() if "CONSOLE" in line]
    if console or 'data-ready="yes"' not in shown.stdout: failures.append(f"{page}: {console or 'not ready'}")
    if page == "walk.html" and not re.search(r'<p id="caption"><', shown.stdout): failures.append("no words on the curves")
# A part that is switched off is not drawn, and a warning about it leads there. The page is changed as a hand would.
def with_script(script, page, name):
    with open(name, "w") as out: out.write(open(page).read().replace("</body>", f"<script>{script}</script></body>"))
    open_page("--screenshot=" + os.path.abspath(name + ".png"), page=name)
    return os.path.getsize(name + ".png")


# Keys, one finger and two turn and zoom the view and step through the clip; the page needs no scrolling.
hands = """stage.setPointerCapture = () => {};
const seen = {};
const after = (name, act) => { const was = {yaw, pitch, zoom, frame}; act();
  seen[name] = Object.entries({yaw, pitch, zoom, frame}).filter(([k, v]) => v !== was[k]).map(([k]) => k); };
const press = key => document.body.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}));
const touch = (kind, pointerId, clientX, clientY) =>
  stage.dispatchEvent(new PointerEvent('pointer' + kind, {pointerId, pointerType: 'touch', clientX, clientY}));
for (const key of ['ArrowLeft', 'ArrowUp', '+', ',']) after(key, () => press(key));
touch('down', 5, 300, 300);
after('finger', () => touch('move', 5, 340, 320));
touch('down', 6, 400, 300);
after('fingers', () => touch('move', 6, 500, 300));
seen.scroll = [document.documentElement.scrollWidth > innerWidth, document.documentElement.scrollHeight > innerHeight];
document.body.dataset.seen = JSON.stringify(seen);"""
expected = {"ArrowLeft": ["yaw"], "ArrowUp": ["pitch"], "+": ["zoom"], ",": ["frame"], "finger": ["yaw", "pitch"],
            "fingers": ["zoom"], "scroll": [False, False]}
with open("hands.html", "w") as out:
    out.write(open("walk.html").read().replace("</body>", f"<script>{hands}</script></body>"))
for window in ["1280,800", "390,844"]:
    shown = open_page("--dump-dom", f"--window-size={window}", page="hands.html")
    seen = re.search(r'data-seen="([^"]*)"', shown.stdout)
    seen = json.loads(html.unescape(seen[1])) if seen else None
    if seen != expected: failures.append(f"hands at {window}: {seen}")
click_parts = "for (const b of document.querySelectorAll('#parts input')) b.click();"
full, none = with_script("", "scene.html", "full.html"), with_script(click_parts, "scene.html", "none.html")
if none > 0.6 * full: failures.append(f"parts do not vanish: a picture of {none} bytes for {full}")
with open("warned.html", "w") as out:
    out.write(open("d.html").read().replace('"warnings":[]', '"warnings":[{"part":"head","text":"Hair, maybe."}]', 1))
shown = open_page("--dump-dom", page="warned.html")
if '<button title="look at head">Hair, maybe.</button>' not in shown.stdout: failures.append("a warning leads nowhere")
# A body of a million vertices: ready within three seconds, without virtual time.
subprocess.run([program, "fit", "--vertices", "1000000", "--tier", "paper", "--html", "large.html", "-q"], check=True)
shown = subprocess.run([browser, "--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                        "--user-data-dir=" + os.path.abspath("profile"), "--dump-dom", "file://" + os.path.abspath("large.html")],
                       capture_output=True, text=True, timeout=200)
ready = re.search(r'data-ms="(\d+)"', shown.stdout)
if not ready or int(ready[1]) > 3000: failures.append(f"a large page is ready after {ready and ready[1]} ms")
else: print(f"a page of a million vertices is ready after {ready[1]} ms")
print(*["FAILED: " + f for f in failures], f"page of {size / 1e6:.1f} MB", sep="\n")
sys.exit(1 if failures else 0)
