// Distances in WebAssembly: node rows.mjs PACKAGE FOLDER CALLS; see rows.py.
import {readFileSync} from 'node:fs';
import path from 'node:path';
import {pathToFileURL} from 'node:url';

const kPart = 10000;
const [root, folder, calls] = process.argv.slice(2);
const {load} = await import(pathToFileURL(path.join(root, 'bodice.mjs')));
const bodice = await load();
const file = readFileSync(path.join(folder, 'points.f32'));
const points = new Float32Array(file.buffer, file.byteOffset, file.length / 4);
for (const name of ['tight', 'relief']) {
  const body = bodice.loadProxy(readFileSync(path.join(folder, `${name}.bodice`)));
  let sum = 0;
  for (let begin = 0; begin < points.length; begin += 3 * kPart) {
    const part = points.subarray(begin, begin + 3 * kPart);
    let least = Infinity;
    for (let call = 0; call < Number(calls); ++call) {
      const start = performance.now();
      body.signedDistance(part);
      least = Math.min(least, 1e3 * (performance.now() - start));
    }
    sum += least;
  }
  console.log(`distances ${name} ${sum.toFixed(1)}`);
}
