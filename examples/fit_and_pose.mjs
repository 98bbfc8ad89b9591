// A mesh becomes a proxy, bones move it, particles collide, and another body takes over, in JavaScript (node, browser).
//
//    positions, faces --skin, fit--> body --pose(matrices)--> body in a pose --resolve(particles)--> outside
//
//     node fit_and_pose.mjs PACKAGE [body.obj]     PACKAGE: build/web/package, made by `bash tests/web/run`
import {readFile} from 'node:fs/promises';
import path from 'node:path';
import {pathToFileURL} from 'node:url';

const [root, file] = process.argv.slice(2);
const {load} = await import(pathToFileURL(path.resolve(root, 'bodice.mjs')));
const {findUnit, readMesh} = await import(pathToFileURL(path.resolve(root, 'readers.mjs')));
const bodice = await load();

// A body of a file, in any unit, or the built-in one.
async function meshOf(name) {
  if (!name) {
    const made = bodice.builtInSkin(), mesh = {positions: made.positions, faces: made.faces};
    made.destroy();
    return mesh;
  }
  const {positions, faces} = readMesh(await readFile(name), name), {meters} = findUnit(positions);
  return {positions: positions.map(x => x * meters), faces};
}

const {positions, faces} = await meshOf(file);
let at = '';
const skin = bodice.skin(positions, faces, {findRig: true, onStage: stage => { if (stage !== at) console.log(`${at = stage} ...`); }});
let body = skin.fit({tier: 'solid'});
console.log(`${skin.stature.toFixed(2)} m tall, waist ${skin.measurements.waist.toFixed(2)} m; ` +
            `${body.ellipsoids.length} ellipsoids, ${body.joints.length} joints`);

// What a file would hold, and the proxy of it.
const again = bodice.loadProxy(body.toBytes());
if (again.hash !== body.hash) throw new Error('a proxy is what its bytes hold');
again.destroy();

// Bones: 12 numbers a joint, row after row. The whole body moves forward, one millimeter a frame.
const rest = Float32Array.from(body.joints.flatMap((_, joint) => [...body.bindMatrix(joint)]));
for (let frame = 0; frame < 30; ++frame)
  body.pose(rest.map((x, i) => i % 12 === 11 ? x + 0.001 * frame : x), 1 / 60);

// Particles in the memory of the library: views that frames write to.
const particles = body.particles(1000);
particles.positions.set(positions.slice(0, 3000));
particles.inverseMass[0] = 0;  // this one is pinned
const contacts = body.resolve(particles, {thickness: 0.002});
const outside = Math.min(...body.signedDistance(particles.positions).subarray(1));

// Another body takes over between two frames; particles stay.
const taller = bodice.skin(positions.map(x => 1.1 * x), faces), next = taller.fit({tier: 'solid'});
body.destroy();
body = next;
const then = body.resolve(particles);
console.log(`${contacts} contacts, ${then} with the body of ${taller.stature.toFixed(2)} m`);
process.exitCode = contacts > 100 && outside > 0 && then > 0 && particles.positions[0] === Math.fround(positions[0]) ? 0 : 1;
