// A host in TypeScript, which uses every declaration of the package. It is checked by tsc alone, and never runs.
import {load, BodiceError, type Bodice, type Body, type Contacts, type FittedBody, type Skin, type Tier} from 'bodice';
import {findUnit, readMesh, type MeshFile} from 'bodice/readers';

async function fitted(bytes: Uint8Array, name: string, tier: Tier): Promise<FittedBody> {
  const file: MeshFile = readMesh(bytes, name);
  const {unit, meters} = findUnit(file.positions);
  const bodice: Bodice = await load({wasm: bytes});
  const skin: Skin = bodice.skin(file.positions.map(x => x * meters), file.faces,
                                 {shape: 'any', findRig: true, onStage: stage => console.log(unit, stage.length)});
  const elbow: number[] | undefined = skin.landmarks.elbow_l?.position;
  const waist: number = skin.measurements.waist + (elbow ? elbow[0] : 0) + skin.stature + skin.vertexOfInput[0];
  const body = skin.fit({tier, maxEllipsoids: 89, targetError: 0.001});
  console.log(waist, body.report.gapMean, body.report.interiorCovered, bodice.partNames[skin.parts[0]], bodice.build);
  skin.destroy();
  return body;
}

export function frame(body: Body, matrices: Float32Array): number {
  const particles = body.particles(100);
  particles.inverseMass[0] = 0;
  body.pose(matrices, 1 / 60);
  const contacts: Contacts = body.contacts(particles.positions, {within: 0.1, fast: true});
  const moved = body.resolve(particles, {thickness: 0.002, friction: 0.3});
  particles.destroy();
  const first = body.ellipsoids[contacts.ellipsoid[0]];
  return moved + body.bindMatrix(0)[3] + first.radii[0] + first.axes[0][0] + contacts.normal[0] + body.toBytes().length;
}

export async function host(bytes: Uint8Array): Promise<string> {
  try {
    const body = await fitted(bytes, 'body.glb', 'relief');
    // @ts-expect-error There is no such tier.
    await fitted(bytes, 'body.glb', 'best');
    // @ts-expect-error Numbers of a body are not written.
    body.stature = 2;
    return body.hash + body.joints.join() + body.signedDistance([0, 1, 0])[0];
  } catch (error) {
    return error instanceof BodiceError ? error.message : 'another failure';
  }
}
