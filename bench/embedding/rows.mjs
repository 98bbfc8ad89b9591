// Distances in WebAssembly: node rows.mjs PACKAGE FOLDER CALLS; see rows.py.
import {readFileSync} from 'node:fs';
import path from 'node:path';
import {pathToFileURL} from 'node:url';

const [root, folder, calls] = process.argv.slice(2);
const {load} = await import(pathToFileURL(path.join(root, 'bodice.mjs')));
const bodice = await load();
const file = readFileSync(path.join(folder, 'points.f32'));
const points = new Float32Array(file.buffer, file.byteOffset, file.length / 4);
for (const name of ['tight', 'relief']) {
  const body = bodice.loadProxy(readFileSync(path.join(folder, `${name}.bodice`)));
  let least = Infinity;
  for (let call = 0; call < Number(calls); ++call) {
    const begin = performance.now();
    body.signedDistance(points);
    least = Math.min(least, 1e3 * (performance.now() - begin));
  }
  console.log(`distances ${name} ${least.toFixed(1)}`);
}
