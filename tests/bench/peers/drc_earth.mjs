// node drc_earth.mjs TILESET.json LEVEL.drc OUT.earth
//
// Decodes a level that farhorizon wrote, with draco3d, and writes where its vertices are on the
// Earth (over_grid.cpp has the format): as the bytes say, with all that rounding has done to them.
// Positions are whole numbers of a lattice in the tile's frame, whose axes are the tileset's
// transform.
import fs from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';

const [tilesetPath, drcPath, outPath] = process.argv.slice(2);
const require = createRequire(path.resolve(process.env.PEERS_PACKAGES ?? '.') + '/');
const draco = await require('draco3d').createDecoderModule({});

function fail(message) {
  console.error(`${drcPath}: ${message}`);
  process.exit(1);
}

const bytes = fs.readFileSync(drcPath);
const decoder = new draco.Decoder();
const mesh = new draco.Mesh();
const status = decoder.DecodeArrayToMesh(new Int8Array(bytes), bytes.length, mesh);
if (!status.ok()) fail(status.error_msg());

const metadata = decoder.GetMetadata(mesh), querier = new draco.MetadataQuerier();
const entry = name => querier.GetDoubleEntry(metadata, name);
const origin = ['east', 'north', 'up'].map(axis => entry(`lattice_origin_${axis}`));
const step = entry('lattice_step');
if (!(step > 0)) fail('its metadata name no lattice');

const count = mesh.num_points();
const numbers = new draco.DracoFloat32Array();
const positions = decoder.GetAttribute(mesh, decoder.GetAttributeId(mesh, draco.POSITION));
decoder.GetAttributeFloatForAllPoints(mesh, positions, numbers);

// A point that Draco stores twice (another normal) is one vertex.
const vertexOf = new Int32Array(count), vertices = [], known = new Map();
const frame = JSON.parse(fs.readFileSync(tilesetPath)).root.transform;
for (let i = 0; i < count; ++i) {
  const lattice = [0, 1, 2].map(axis => numbers.GetValue(3 * i + axis));
  const key = lattice.join();
  if (!known.has(key)) {
    known.set(key, known.size);
    const [east, north, up] = lattice.map((n, axis) => origin[axis] + step * n);
    for (let axis = 0; axis < 3; ++axis)
      vertices.push(frame[axis] * east + frame[4 + axis] * north + frame[8 + axis] * up +
                    frame[12 + axis]);
  }
  vertexOf[i] = known.get(key);
}

const face = new draco.DracoInt32Array();
const triangles = new Int32Array(3 * mesh.num_faces());
for (let i = 0; i < mesh.num_faces(); ++i) {
  decoder.GetFaceFromMesh(mesh, i, face);
  for (let corner = 0; corner < 3; ++corner)
    triangles[3 * i + corner] = vertexOf[face.GetValue(corner)];
}
const parts = [new Int32Array([vertices.length / 3, triangles.length / 3]),
               Float64Array.from(vertices), triangles];
fs.writeFileSync(outPath, Buffer.concat(parts.map(part => new Uint8Array(part.buffer))));
