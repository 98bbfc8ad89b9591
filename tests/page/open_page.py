"""Opens a page in headless Chromium, from a file: it comes up without a message on the console, is a page of at most
6 MB for the default drape, and draws the body. WebGL is done in software."""
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
if not re.search(r'<label><input type="checkbox"> landmarks', shown.stdout): failures.append("no checkboxes")
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
print(*["FAILED: " + f for f in failures], f"page of {size / 1e6:.1f} MB", sep="\n")
sys.exit(1 if failures else 0)
