// Distances in WebAssembly: node rows.mjs PACKAGE FOLDER CALLS; see rows.py.
// An engine runs new code by a quick compiler first and replaces it, behind the calls, by a better one. The rows are of
// the latter, as in every frame but the first few; what the first call takes is printed beside them.
import {readFileSync} from 'node:fs';
import path from 'node:path';
import {pathToFileURL} from 'node:url';

const kPart = 10000, kWarmUpMs = 2000;
const into = new Float32Array(kPart);  // as the distances of the other languages go into an array that is there
const [root, folder, calls] = process.argv.slice(2);
const {load} = await import(pathToFileURL(path.join(root, 'bodice.mjs')));
const bodice = await load();
const file = readFileSync(path.join(folder, 'points.f32'));
const points = new Float32Array(file.buffer, file.byteOffset, file.length / 4);
for (const name of ['tight', 'relief']) {
  const body = bodice.loadProxy(readFileSync(path.join(folder, `${name}.bodice`)));
  const first = performance.now();
  body.signedDistance(points);
  const firstCall = 1e3 * (performance.now() - first);
  while (performance.now() - first < kWarmUpMs) body.signedDistance(points);
  let sum = 0;
  for (let begin = 0; begin < points.length; begin += 3 * kPart) {
    const part = points.subarray(begin, begin + 3 * kPart);
    let least = Infinity;
    for (let call = 0; call < Number(calls); ++call) {
      const start = performance.now();
      body.signedDistance(part, {into});
      least = Math.min(least, 1e3 * (performance.now() - start));
    }
    sum += least;
  }
  console.log(`distances ${name} ${sum.toFixed(1)}`);
  console.log(`first ${name} ${firstCall.toFixed(1)}`);
}
