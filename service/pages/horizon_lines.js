'use strict';
// Horizon edges: read from lodN-horizon.glb or horizon.geojson, and drawn as lines of a width.
(() => {
  // The colours of report.html: blue, bluish green, yellow, vermilion and purple, 36 degrees apart.
  const kColours = [[0, 114, 178], [0, 158, 115], [222, 170, 0], [213, 94, 0], [176, 82, 154]];
  const colourOf = (azimuth) => {
    const place = (((azimuth % 180) + 180) % 180) / 180 * kColours.length;
    const before = Math.floor(place) % kColours.length;
    const after = kColours[(before + 1) % kColours.length];
    const share = place - Math.floor(place);
    // Squares are about proportional to light.
    return kColours[before].map(
      (from, i) => Math.round(Math.sqrt((1 - share) * from * from + share * after[i] * after[i])));
  };

  // The middle of the widest of the intervals [from, to].
  const middleOf = (intervals) => {
    if (!intervals?.length) return 0;
    const widest = intervals.reduce((a, b) => (b[1] - b[0] > a[1] - a[0] ? b : a));
    return (widest[0] + widest[1]) / 2;
  };
  // The middle of the longest run of bits of a half turn in 64, which goes round.
  const middleOfMask = (low, high) => {
    const isSet = (i) => ((i & 32 ? high : low) >>> (i & 31)) & 1;
    let [best, from, run] = [0, 0, 0];
    for (let i = 0; i < 128; ++i) {
      run = isSet(i & 63) ? Math.min(run + 1, 64) : 0;
      if (run > best) [best, from] = [run, i + 1 - run];
    }
    return (from + best / 2) * 180 / 64;
  };

  // The JSON of a GLB.
  const gltfOf = (bytes) => JSON.parse(new TextDecoder().decode(
    new Uint8Array(bytes, 20, new DataView(bytes).getUint32(12, true))));

  // Lines as { ends: earth-fixed x, y, z of both ends of each, azimuths: of each }.
  const readGlb = (C, bytes, transform) => {
    const gltf = gltfOf(bytes);
    const start = 20 + new DataView(bytes).getUint32(12, true) + 8;
    const kTypes = { 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array,
      UINT8: Uint8Array, UINT16: Uint16Array, UINT32: Uint32Array };
    const array = (type, index) => {
      const { byteOffset = 0, byteLength } = gltf.bufferViews[index];
      return new kTypes[type](bytes.slice(start + byteOffset, start + byteOffset + byteLength));
    };
    const primitive = gltf.meshes[0].primitives[0];
    const accessor = gltf.accessors[primitive.attributes.POSITION];
    const positions = array(accessor.componentType, accessor.bufferView);
    // How many numbers one vertex has: those of 16 bits have a fourth, for alignment.
    const { byteStride = 12 } = gltf.bufferViews[accessor.bufferView];
    const stride = byteStride / positions.BYTES_PER_ELEMENT;
    const { componentType, bufferView } = gltf.accessors[primitive.indices];
    const indices = array(componentType, bufferView);
    const matrix = C.Matrix4.clone(transform);
    C.Matrix4.multiply(matrix, C.Axis.Y_UP_TO_Z_UP, matrix);
    const node = gltf.nodes.find((one) => one.mesh === 0);
    if (node.matrix) C.Matrix4.multiply(matrix, C.Matrix4.fromArray(node.matrix), matrix);
    const ends = new Float64Array(3 * indices.length);
    const point = new C.Cartesian3();
    for (let i = 0; i < indices.length; ++i) {
      C.Cartesian3.fromArray(positions, stride * indices[i], point);
      C.Cartesian3.pack(C.Matrix4.multiplyByPoint(matrix, point, point), ends, 3 * i);
    }
    // A row of the table is a chain: so many lines, after those of the chains before it.
    const { schema, propertyTables: [table] } = gltf.extensions.EXT_structural_metadata;
    const column = (name) => array(
      schema.classes[table.class].properties[name].componentType, table.properties[name].values);
    const masks = column('azimuths');
    const azimuths = new Float32Array(indices.length / 2);
    let first = 0;
    column('edges').forEach((count, chain) => {
      azimuths.fill(
        middleOfMask(masks[2 * chain], masks[2 * chain + 1]), first, first + count);
      first += count;
    });
    return { ends, azimuths };
  };
  // A feature is an edge, with its azimuths as intervals and `level_kept`; or a chain of edges, with
  // its azimuths as a mask in hexadecimal digits and `levels_kept`, a digit an edge.
  const azimuthOf = ({ azimuths }) => (typeof azimuths === 'string'
    ? middleOfMask(parseInt(azimuths.slice(8), 16), parseInt(azimuths.slice(0, 8), 16))
    : middleOf(azimuths));
  const readGeojson = (C, document, level) => {
    const ends = [];
    const azimuths = [];
    for (const { geometry, properties } of document.features) {
      const chains = geometry.type === 'LineString' ? [geometry.coordinates] : geometry.coordinates;
      const azimuth = azimuthOf(properties);
      let edge = 0;
      for (const chain of chains) {
        const points = chain.map(
          ([longitude, latitude, height]) => C.Cartesian3.fromDegrees(longitude, latitude, height));
        for (let i = 1; i < points.length; ++i, ++edge) {
          const kept = properties.level_kept ?? parseInt(properties.levels_kept?.[edge], 16);
          if (!(kept >= level)) continue;
          for (const { x, y, z } of [points[i - 1], points[i]]) ends.push(x, y, z);
          azimuths.push(azimuth);
        }
      }
    }
    return { ends: Float64Array.from(ends), azimuths: Float32Array.from(azimuths) };
  };

  // Each line is four corners that are put half a width beside it, on the screen; all of them a
  // five-hundredth of their distance nearer to the eye, so that the mesh that they lie on does not
  // hide them.
  const kVertexShader = `
    in vec3 position3DHigh;
    in vec3 position3DLow;
    in vec3 along;
    in vec4 color;
    in float side;
    in float batchId;
    out vec4 v_color;
    const float HALF_WIDTH = 1.1;
    vec4 clipped(vec4 point, vec4 other) {
      float near = -czm_currentFrustum.x;
      if (point.z <= near || other.z >= near) return point;
      return mix(other, point, (near - other.z) / (point.z - other.z));
    }
    void main() {
      vec4 here = czm_modelViewRelativeToEye * czm_computePosition();
      vec4 there = vec4(here.xyz + mat3(czm_modelViewRelativeToEye) * along, 1.0);
      vec4 a = clipped(here, there);
      vec4 b = clipped(there, here);
      a.xyz *= 0.998;
      b.xyz *= 0.998;
      a = czm_projection * a;
      b = czm_projection * b;
      vec2 d = (b.xy / b.w - a.xy / a.w) * czm_viewport.zw;
      d = dot(d, d) > 0.0 ? normalize(d) : vec2(1.0, 0.0);
      a.xy += vec2(-d.y, d.x) * side * HALF_WIDTH * 2.0 / czm_viewport.zw * a.w;
      gl_Position = a;
      v_color = color;
    }`;
  const kFragmentShader = `
    in vec4 v_color;
    void main() { out_FragColor = v_color; }`;

  // colour: of a line's azimuth, three bytes.
  const makePrimitive = (C, { ends, azimuths }, colour) => {
    const count = azimuths.length;
    const position = new Float64Array(12 * count);
    const along = new Float32Array(12 * count);
    const side = new Float32Array(4 * count);
    const color = new Uint8Array(16 * count);
    const indices = new Uint32Array(6 * count);
    for (let line = 0; line < count; ++line) {
      const rgb = colour(azimuths[line]);
      for (let corner = 0; corner < 4; ++corner) {
        const end = corner >> 1;
        for (let k = 0; k < 3; ++k) {
          const here = ends[6 * line + 3 * end + k];
          position[12 * line + 3 * corner + k] = here;
          along[12 * line + 3 * corner + k] = ends[6 * line + 3 * (1 - end) + k] - here;
        }
        // From the other end the line is seen backwards, so left is right.
        side[4 * line + corner] = (corner & 1) === end ? 1 : -1;
        color.set([...rgb, 255], 16 * line + 4 * corner);
      }
      indices.set([0, 1, 2, 2, 1, 3].map((corner) => 4 * line + corner), 6 * line);
    }
    const attribute = (componentDatatype, componentsPerAttribute, values, normalize = false) =>
      new C.GeometryAttribute({ componentDatatype, componentsPerAttribute, values, normalize });
    const attributes = new C.GeometryAttributes({
      position: attribute(C.ComponentDatatype.DOUBLE, 3, position),
      color: attribute(C.ComponentDatatype.UNSIGNED_BYTE, 4, color, true),
    });
    attributes.along = attribute(C.ComponentDatatype.FLOAT, 3, along);
    attributes.side = attribute(C.ComponentDatatype.FLOAT, 1, side);
    return new C.Primitive({
      geometryInstances: new C.GeometryInstance({
        geometry: new C.Geometry({
          attributes, indices, primitiveType: C.PrimitiveType.TRIANGLES,
          boundingSphere: C.BoundingSphere.fromVertices(ends),
        }),
      }),
      appearance: new C.Appearance({
        translucent: false, vertexShaderSource: kVertexShader,
        fragmentShaderSource: kFragmentShader,
        renderState: { depthTest: { enabled: true }, cull: { enabled: false } },
      }),
      asynchronous: false, allowPicking: false, compressVertices: false,
    });
  };

  farhorizon.horizonLines = { colourOf, gltfOf, readGlb, readGeojson, makePrimitive };
})();
