// Opens the package's page in headless Chromium: drops a body in centimeters and another one as GLB on it, which are
// fitted, looks at the pictures, drops a proxy with its body, and turns it. The page and its worker request files of
// the page alone, and send nothing.
import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import {createServer} from 'node:http';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import path from 'node:path';

const {BODICE_WEB: root, BODICE_SCRATCH: scratch, BODICE_PROGRAM: program} = process.env;
const TYPES = {'.html': 'text/html', '.css': 'text/css', '.mjs': 'text/javascript', '.wasm': 'application/wasm'};
const server = createServer((request, response) => {
  try {
    const file = path.join(root, path.normalize(new URL(request.url, 'http://h').pathname));
    response.setHeader('Content-Type', TYPES[path.extname(file)] ?? 'application/octet-stream');
    response.end(readFileSync(file));
  } catch {
    response.statusCode = 404;
    response.end();
  }
});
await new Promise(done => server.listen(0, '127.0.0.1', done));
const home = `http://127.0.0.1:${server.address().port}`;

const profile = mkdtempSync(path.join(tmpdir(), 'bodice-page-'));
const browser = spawn('chromium', ['--headless=new', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
                                   '--window-size=1280,800', `--user-data-dir=${profile}`, '--remote-debugging-pipe'],
                      {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']});
const answers = new Map(), events = [];
let last = 0, rest = '';
browser.stdio[4].on('data', data => {
  const messages = (rest + data).split('\0');
  rest = messages.pop();
  for (const message of messages.map(text => JSON.parse(text)))
    message.id ? answers.get(message.id)(message) : happened(message);
});
const ask = (method, params = {}, sessionId = undefined) => new Promise((done, fail) => {
  answers.set(++last, ({result, error}) => error ? fail(new Error(`${method}: ${error.message}`)) : done(result));
  browser.stdio[3].write(JSON.stringify({id: last, method, params, sessionId}) + '\0');
});

/** Events of the page and of its workers; a worker starts when its requests are listened to. */
function happened(event) {
  events.push(event);
  if (event.method !== 'Target.attachedToTarget' || event.params.targetInfo.type !== 'worker') return;
  for (const method of ['Network.enable', 'Runtime.runIfWaitingForDebugger'])
    ask(method, {}, event.params.sessionId).catch(error => { events.push({method: 'failed', params: error.message}); });
}

/** Every request stays with the page's server or inside the browser, and none carries anything. */
function checkRequests() {
  const all = events.filter(e => e.method === 'Network.requestWillBeSent').map(e => e.params.request);
  for (const file of ['page.mjs', 'worker.mjs', 'bodice_wasm.wasm'])
    assert.ok(all.some(({url}) => url.endsWith(`/${file}`)), `no request for ${file} is seen: what else is not?`);
  const outside = all.filter(({url, method, hasPostData}) => method !== 'GET' || hasPostData ||
                             !(url.startsWith(`${home}/`) && !url.includes('?') || /^(blob|data):/.test(url)));
  assert.deepEqual(outside.map(({method, url}) => `${method} ${url}`), []);
  const others = events.filter(({method}) => /^(failed|Network.(webSocketCreated|webTransportCreated))$/.test(method));
  assert.deepEqual(others.map(event => JSON.stringify(event)), []);
  return all.length;
}

async function run() {
  const {targetId} = await ask('Target.createTarget', {url: 'about:blank'});
  const {sessionId} = await ask('Target.attachToTarget', {targetId, flatten: true});
  const page = (method, params) => ask(method, params, sessionId);
  const evaluate = async expression => {
    const {result, exceptionDetails} = await page('Runtime.evaluate', {expression, awaitPromise: true, returnByValue: true});
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  };
  const text = () => evaluate('document.getElementById("state")?.textContent');
  const state = async (wanted, seconds = 120) => {
    for (const end = Date.now() + 1000 * seconds; Date.now() < end; await new Promise(r => setTimeout(r, 100)))
      if (await evaluate(wanted instanceof RegExp ? `${wanted}.test(document.getElementById("state")?.textContent)` : wanted))
        return text();
    throw new Error(`the page never showed ${wanted}: ${await text()}`);
  };
  const picture = async name => {
    await evaluate('new Promise(r => requestAnimationFrame(() => requestAnimationFrame(r)))');
    const {data} = await page('Page.captureScreenshot', {format: 'png'});
    writeFileSync(path.join(scratch, `${name}.png`), data, 'base64');
    return data;
  };
  const drop = (files, encoded = false) => evaluate(`{
    const transfer = new DataTransfer();
    for (const [name, text] of Object.entries(${JSON.stringify(files)}))
      transfer.items.add(new File([${encoded} ? Uint8Array.from(atob(text), c => c.charCodeAt(0)) : text], name));
    document.getElementById('stage').dispatchEvent(new DragEvent('drop', {dataTransfer: transfer, bubbles: true}));
  }`);

  await page('Target.setAutoAttach', {autoAttach: true, waitForDebuggerOnStart: true, flatten: true});
  await page('Network.enable');
  await page('Page.enable');
  await page('Runtime.enable');
  await page('Log.enable');
  await page('Page.navigate', {url: `${home}/page/index.html`});
  await state(/^Ready/);
  const obj = readFileSync(path.join(scratch, 'made.obj'), 'utf8');
  const centimeters = obj.replace(/^v (\S+) (\S+) (\S+).*$/gm, (_, ...xyz) => 'v ' + xyz.slice(0, 3).map(x => 100 * x).join(' '));
  await drop({'triangle.obj': 'v 0 0 0\nv 1.7 0 0\nv 0 1.7 0\nf 1 2 3\n'});
  await state(`!!document.querySelector('#state.wrong')`);
  await drop({'made.obj': centimeters});
  await state(/^Fitted/, 300);
  const fitted = await picture('page_fitted');
  const found = await evaluate('document.getElementById("numbers").innerText');
  assert.match(found, /stature\s+16\d\.\d cm/);
  assert.match(found, /centimeters/);
  assert.ok(Number(found.match(/mean\s+([\d.]+) mm/)[1]) < 0.4, found);
  await evaluate(`document.querySelector('input[value=parts]').click()`);
  assert.notEqual(await picture('page_parts'), fitted);
  const saved = await evaluate(`fetch(document.getElementById('save').href).then(r => r.arrayBuffer()).then(b => b.byteLength)`);
  assert.ok(saved > 50000, `the saved proxy has ${saved} bytes`);

  execFileSync(program, ['rig', path.join(scratch, 'made.obj'), '-o', path.join(scratch, 'made.glb'), '-q']);
  await evaluate(`document.getElementById('state').textContent = ''`);
  await drop({'made.glb': readFileSync(path.join(scratch, 'made.glb')).toString('base64')}, true);
  await state(/^Fitted/, 300);
  const again = await evaluate('document.getElementById("numbers").innerText');
  assert.match(again, /unit of the file\s+meters/);
  assert.equal(again.match(/stature\s+([\d.]+) cm/)[1], found.match(/stature\s+([\d.]+) cm/)[1]);
  assert.ok(Number(again.match(/mean\s+([\d.]+) mm/)[1]) < 0.4, again);

  const proxy = readFileSync(path.join(scratch, 'native.bodice')).toString('base64');
  await drop({'body.bodice': proxy}, true);
  await state(/^The proxy/);
  const ellipsoids = await picture('page_ellipsoids');
  await drop({'made.obj': centimeters});
  await state(/^The body/);
  const numbers = await evaluate('document.getElementById("numbers").innerText');
  assert.match(numbers, /centimeters/);
  assert.match(numbers, /stature\s+1[67]\d\.\d cm/);
  const gap = Number(numbers.match(/mean\s+([\d.]+) mm/)[1]);
  assert.ok(gap < 1, `the mean distance is ${gap} mm`);

  const painted = () => evaluate(`{
    const gl = document.getElementById('view').getContext('webgl'), w = gl.drawingBufferWidth, h = gl.drawingBufferHeight;
    const all = new Uint8Array(4 * w * h);
    gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, all);
    let count = 0;
    for (let i = 3; i < all.length; i += 4) count += all[i] > 0;
    count / (w * h);
  }`);
  const front = await picture('page_error');
  assert.notEqual(front, ellipsoids);
  const share = await painted();
  assert.ok(share > 0.04 && share < 0.6, `${share} of the view is painted`);
  for (const [type, x] of [['mousePressed', 300], ['mouseMoved', 500], ['mouseReleased', 500]])
    await page('Input.dispatchMouseEvent', {type, x, y: 400, button: 'left', buttons: 1, clickCount: 1});
  assert.notEqual(await picture('page_turned'), front);
  await evaluate(`document.querySelector('input[value=both]').click()`);
  assert.notEqual(await picture('page_both'), front);
  const errors = events.filter(e => e.method === 'Runtime.exceptionThrown' ||
      e.method === 'Log.entryAdded' && e.params.entry.level === 'error' && !/favicon/.test(e.params.entry.url ?? ''));
  assert.deepEqual(errors.map(e => JSON.stringify(e.params)), []);
  const requests = checkRequests();
  console.log(`page: the body is ${gap} mm from its proxy; ${requests} requests, none to elsewhere`);
}

try {
  await run();
} finally {
  const ended = new Promise(done => browser.exitCode !== null ? done() : browser.on('exit', done));
  ask('Browser.close').catch(() => {});  // killed at once, it would leave processes that still write to the profile
  setTimeout(() => browser.kill(), 10000).unref();
  server.close();
  await ended;
  rmSync(profile, {recursive: true, force: true, maxRetries: 5});
}
