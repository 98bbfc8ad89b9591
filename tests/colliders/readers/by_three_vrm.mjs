// Prints the colliders of a VRM file as three-vrm sees them, one a line in JSON: ends in the world, radius. The file has
// colliders alone, so that a strand of hair which uses them is added first.
import fs from 'node:fs';
import path from 'node:path';
import {pathToFileURL} from 'node:url';

globalThis.self = globalThis;
const [folder, file] = process.argv.slice(2);
const load = name => import(pathToFileURL(path.resolve(folder, name)));
const {GLTFLoader} = await load('three/examples/jsm/loaders/GLTFLoader.js');
const {VRMSpringBoneLoaderPlugin} = await load('@pixiv/three-vrm-springbone/lib/three-vrm-springbone.module.js');
const data = JSON.parse(fs.readFileSync(file));
const hair = data.nodes.length;
data.nodes.push({name: 'hair', children: [hair + 1]}, {name: 'hair_end', translation: [0, -0.1, 0]});
data.scenes[0].nodes.push(hair);
data.extensions.VRMC_springBone.springs = [{joints: [{node: hair}, {node: hair + 1}], colliderGroups: [0]}];
const loader = new GLTFLoader();
loader.register(parser => new VRMSpringBoneLoaderPlugin(parser));
loader.parse(JSON.stringify(data), '', gltf => {
  gltf.scene.updateMatrixWorld(true);
  for (const {shape, parent} of gltf.userData.vrmSpringBoneManager.colliders) {
    const world = point => point.clone().applyMatrix4(parent.matrixWorld).toArray();
    console.log(JSON.stringify({a: world(shape.offset), b: world(shape.tail || shape.offset), radius: shape.radius}));
  }
}, error => { console.error(error); process.exit(1); });
