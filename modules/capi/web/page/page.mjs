// The page: hands files to the worker, and shows the body, its proxy, and how far the two are apart.
import {ellipsoidMesh, errorColors, limitOf, partColors} from './colors.mjs';
import {View} from './view.mjs';

const $ = id => document.getElementById(id);
const STAGES = {read: 'Reading ...', repair: 'Repairing ...', segment: 'Finding landmarks and parts ...', fit: 'Fitting ...'};
const view = new View($('view'));
const worker = new Worker(new URL('./worker.mjs', import.meta.url), {type: 'module'});
let shown = null, name = 'body';

function say(text, wrong = false) {
  $('state').textContent = text;
  $('state').classList.toggle('wrong', wrong);
}

const row = (what, value) => {
  const line = document.createElement('tr');
  line.append(...[what, value].map(text => Object.assign(document.createElement('td'), {textContent: text})));
  return line;
};

function list({proxy, skin, waist, seconds}) {
  const cm = meters => `${(100 * meters).toFixed(1)} cm`;
  const rows = [row('stature', cm(proxy.stature)), row('tier', proxy.tier),
                row('ellipsoids', String(proxy.ellipsoids.length)), row('joints', String(proxy.joints))];
  if (waist > 0) rows.splice(1, 0, row('waist', cm(waist)));
  if (skin) {
    const mean = skin.error.reduce((sum, e) => sum + Math.abs(e), 0) / skin.error.length;
    rows.push(row('vertices of the body', String(skin.error.length)), row('unit of the file', skin.unit),
              row('distance from the proxy, mean', `${mean.toFixed(2)} mm`));
  }
  if (proxy.report) rows.push(row('inside covered', `${(100 * proxy.report.interiorCovered).toFixed(2)} %`));
  rows.push(row('time', `${seconds.toFixed(1)} s`));
  $('numbers').replaceChildren(...rows);
}

function show() {
  const what = document.querySelector('input[name=what]:checked').value, {skin, proxy} = shown;
  view.clear();
  if (what !== 'ellipsoids')
    view.add(skin.positions, skin.faces, what === 'parts' ? partColors(skin.parts) : errorColors(skin.error),
             what === 'both' ? 0.35 : 1);
  if (what === 'ellipsoids' || what === 'both') {
    const {positions, faces, colors} = ellipsoidMesh(proxy.ellipsoids);
    view.add(positions, faces, colors, 1);
  }
  $('legend').hidden = what !== 'error' && what !== 'both';
  view.draw();
}

/** Lets what is shown be chosen among what there is. */
function offer(found) {
  const there = {ellipsoids: true, error: !!found.skin, both: !!found.skin, parts: !!found.skin?.parts};
  for (const input of document.querySelectorAll('input[name=what]')) input.disabled = !there[input.value];
  document.querySelector(`input[value=${found.skin ? 'error' : 'ellipsoids'}]`).checked = true;
  $('show').hidden = false;
  $('save').hidden = !found.bytes;
  if (!found.bytes) return;
  URL.revokeObjectURL($('save').href);
  $('save').href = URL.createObjectURL(new Blob([found.bytes]));
  $('save').download = `${name}.bodice`;
}

function take(found) {
  shown = found;
  list(found);
  offer(found);
  if (found.skin) {
    const limit = limitOf(found.skin.error);
    $('least').textContent = `-${limit} mm`;
    $('most').textContent = `${limit} mm`;
  }
  view.frame(found.skin ? found.skin.positions : ellipsoidMesh(found.proxy.ellipsoids).positions, found.up);
  show();
  $('warnings').replaceChildren(...(found.warnings ?? []).map(
      text => Object.assign(document.createElement('li'), {textContent: text})));
  say(!found.skin ? 'The proxy. Drop its body to see how near they are.' :
      found.proxy.dropped ? 'The body and its proxy.' : 'Fitted.');
}

worker.onmessage = ({data}) => {
  if (data.failed) return say(data.failed, true);
  if (data.ready) return say('Ready.');
  if (data.stage) return say(STAGES[data.stage] ?? data.stage);
  take(data);
};
worker.onerror = event => say(event.message || 'The worker did not start. Serve this folder over HTTP.', true);

async function submit(files) {
  // A proxy comes first, whatever the order of the files.
  for (const file of [...files].sort((a, b) => b.name.endsWith('.bodice') - a.name.endsWith('.bodice'))) {
    const bytes = new Uint8Array(await file.arrayBuffer());
    say('Working ...');
    if (!file.name.endsWith('.bodice')) name = file.name.replace(/\.[^.]*$/, '');
    worker.postMessage(file.name.endsWith('.bodice') ? {proxy: bytes} : {body: bytes, name: file.name, any: $('any').checked});
  }
}

$('open').onclick = () => $('file').click();
$('file').onchange = () => submit($('file').files);
$('made').onclick = () => { name = 'body'; say('Working ...'); worker.postMessage({made: true}); };
$('show').onchange = show;
addEventListener('dragover', event => { event.preventDefault(); document.body.classList.add('over'); });
addEventListener('dragleave', () => document.body.classList.remove('over'));
addEventListener('drop', event => {
  event.preventDefault();
  document.body.classList.remove('over');
  submit(event.dataTransfer.files);
});
