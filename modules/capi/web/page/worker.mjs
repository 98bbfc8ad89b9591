// Reads bodies, fits them and measures proxies beside the page, so that it stays alive. A message is {proxy: bytes},
// {body: bytes, name, any} or {made: true}; the answer is {stage}, {failed} or what there is to show.
import {load} from '../bodice.mjs';
import {findUnit, readMesh} from '../readers.mjs';

const library = load();
let proxy = null;  // one that was dropped: the next body is compared with it

const onStage = stage => { postMessage({stage}); };

function aboutProxy(body, dropped) {
  return {ellipsoids: body.ellipsoids, tier: body.tier, stature: body.stature, joints: body.joints.length, dropped};
}

/** Distance of the proxy from the skin at each vertex, mm: above 0 where the skin reaches beyond the proxy. */
function aboutSkin(body, positions, faces, unit) {
  const points = Float32Array.from(positions);
  return {positions: points, faces, unit, error: body.signedDistance(points).map(d => 1000 * d)};
}

function takeProxy(bodice, bytes) {
  const next = bodice.loadProxy(bytes);
  proxy?.destroy();
  proxy = next;
  return {proxy: aboutProxy(proxy, true), up: [0, 1, 0]};
}

function compare(positions, faces, unit) {
  const found = {proxy: aboutProxy(proxy, true), skin: aboutSkin(proxy, positions, faces, unit), up: [0, 1, 0]};
  proxy.destroy();
  proxy = null;
  return found;
}

function fit(skin, unit, any) {
  const body = skin.fit({onStage});
  const found = {proxy: {...aboutProxy(body, false), stature: skin.stature, report: body.report},
                 skin: {...aboutSkin(body, skin.positions, skin.faces, unit), parts: skin.parts}, up: skin.up,
                 warnings: skin.warnings, waist: any ? NaN : skin.measurements.waist, bytes: body.toBytes()};
  body.destroy();
  return found;
}

function fitMesh(bodice, positions, faces, unit, any) {
  const skin = bodice.skin(positions, faces, {shape: any ? 'any' : 'person', onStage});
  const found = fit(skin, unit, any);
  skin.destroy();
  return found;
}

function answer(bodice, message) {
  if (message.proxy) return takeProxy(bodice, message.proxy);
  if (message.made) {
    const skin = bodice.builtInSkin(), found = fit(skin, 'meters', false);
    skin.destroy();
    return found;
  }
  onStage('read');
  const {positions, faces} = readMesh(message.body, message.name);
  const {unit, meters} = message.any ? {unit: 'meters', meters: 1} : findUnit(positions);
  const points = positions.map(x => x * meters);
  return proxy ? compare(points, faces, unit) : fitMesh(bodice, points, faces, unit, message.any);
}

onmessage = async ({data}) => {
  const began = performance.now();
  try {
    const found = answer(await library, data);
    postMessage({...found, seconds: (performance.now() - began) / 1000});
  } catch (error) {
    postMessage({failed: error.message});
  }
};
library.then(bodice => postMessage({ready: bodice.build}), error => postMessage({failed: error.message}));
