// The page: takes a proxy and its body, and shows how far the two are apart.
import {load} from '../bodice.mjs';
import {findUnit, readMesh} from '../readers.mjs';
import {ellipsoidMesh, errorColors, limitOf} from './colors.mjs';
import {View} from './view.mjs';

const $ = id => document.getElementById(id);
const view = new View($('view'));
let library = null, proxy = null, skin = null;

function say(text, wrong = false) {
  $('state').textContent = text;
  $('state').classList.toggle('wrong', wrong);
}

const row = (what, value) => {
  const line = document.createElement('tr');
  line.append(...[what, value].map(text => Object.assign(document.createElement('td'), {textContent: text})));
  return line;
};

function list() {
  const rows = [row('stature', `${(100 * proxy.stature).toFixed(1)} cm`), row('tier', proxy.tier),
                row('ellipsoids', String(proxy.ellipsoids.length)), row('joints', String(proxy.joints.length))];
  if (skin) {
    const sizes = Float32Array.from(skin.error, Math.abs), mean = sizes.reduce((a, b) => a + b, 0) / sizes.length;
    rows.push(row('vertices of the body', String(sizes.length)), row('unit of the file', skin.unit),
              row('distance from the proxy, mean', `${mean.toFixed(2)} mm`));
  }
  $('numbers').replaceChildren(...rows);
}

function show() {
  const what = document.querySelector('input[name=what]:checked').value;
  view.clear();
  if (what !== 'ellipsoids') view.add(skin.positions, skin.faces, errorColors(skin.error), what === 'both' ? 0.35 : 1);
  if (what !== 'error') {
    const {positions, faces, colors} = ellipsoidMesh(proxy.ellipsoids);
    view.add(positions, faces, colors, 1);
  }
  $('legend').hidden = what === 'ellipsoids';
  view.draw();
}

function takeProxy(bytes) {
  const next = library.loadProxy(bytes);
  proxy?.destroy();
  proxy = next;
  skin = null;
  $('show').hidden = false;
  for (const input of document.querySelectorAll('input[name=what]')) input.disabled = input.value !== 'ellipsoids';
  document.querySelector('input[value=ellipsoids]').checked = true;
  view.frame(ellipsoidMesh(proxy.ellipsoids).positions, [0, 1, 0]);
}

function takeBody(bytes, name) {
  if (!proxy) throw new Error('Drop a proxy first: bodice fit body.obj -o body.bodice.');
  const {positions, faces} = readMesh(bytes, name), {unit, meters} = findUnit(positions);
  const points = Float32Array.from(positions, x => x * meters);
  const error = proxy.signedDistance(points).map(d => 1000 * d);
  skin = {positions: points, faces, unit, error};
  const limit = limitOf(error);
  $('least').textContent = `-${limit} mm`;
  $('most').textContent = `${limit} mm`;
  for (const input of document.querySelectorAll('input[name=what]')) input.disabled = false;
  document.querySelector('input[value=error]').checked = true;
}

async function take(files) {
  try {
    // The proxy comes first, whatever the order of the files.
    for (const file of [...files].sort((a, b) => b.name.endsWith('.bodice') - a.name.endsWith('.bodice'))) {
      const bytes = new Uint8Array(await file.arrayBuffer());
      file.name.endsWith('.bodice') ? takeProxy(bytes) : takeBody(bytes, file.name);
    }
    list();
    show();
    say(skin ? 'The body and its proxy.' : 'The proxy. Drop its body to see how near they are.');
  } catch (error) {
    say(error.message, true);
  }
}

$('open').onclick = () => $('file').click();
$('file').onchange = () => take($('file').files);
$('show').onchange = show;
addEventListener('dragover', event => { event.preventDefault(); document.body.classList.add('over'); });
addEventListener('dragleave', () => document.body.classList.remove('over'));
addEventListener('drop', event => {
  event.preventDefault();
  document.body.classList.remove('over');
  if (event.dataTransfer.files.length) take(event.dataTransfer.files);
});
try {
  library = await load();
  say('Ready.');
} catch (error) {
  say(error.message, true);
}
