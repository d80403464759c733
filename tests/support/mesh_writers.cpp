#include "tests/support/mesh_writers.h"

#include <algorithm>
#include <cstring>
#include <meshoptimizer.h>
#include <sstream>
#include <stdexcept>

#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>

namespace farhorizon {

namespace {

using Json = nlohmann::json;

template <typename T>
void Put(std::string& bytes, T value, bool big_endian = false) {
  std::string stored(sizeof value, '\0');
  std::memcpy(stored.data(), &value, sizeof value);
  if (big_endian) std::reverse(stored.begin(), stored.end());
  bytes += stored;
}

std::ostringstream Text() {
  std::ostringstream text;
  text.precision(17);
  return text;
}

std::string PlyHead(const PlainMesh& mesh, const char* format) {
  return std::string("ply\nformat ") + format + " 1.0\ncomment made by a test\nelement vertex " +
         std::to_string(mesh.points.size()) +
         "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\n"
         "element face " +
         std::to_string(mesh.triangles.size()) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

// Adds `part` to the buffer and a view of it.
std::size_t AddView(TestGltf& gltf, const std::string& part) {
  gltf.buffer.resize((gltf.buffer.size() + 3) / 4 * 4, '\0');
  Json& views = gltf.json["bufferViews"];
  views.push_back({{"buffer", 0}, {"byteOffset", gltf.buffer.size()}, {"byteLength", part.size()}});
  gltf.buffer += part;
  return views.size() - 1;
}

TestGltf Frame(const PlainMesh& mesh, int position_type, int index_type) {
  TestGltf gltf;
  gltf.json = {
      {"asset", {{"version", "2.0"}}},
      {"scene", 0},
      {"scenes", Json::array({{{"nodes", {0}}}})},
      {"nodes", Json::array({{{"mesh", 0}}})},
      {"meshes",
       Json::array(
           {{{"primitives", Json::array({{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}})}}})},
      {"bufferViews", Json::array()},
      {"accessors",
       Json::array(
           {{{"componentType", position_type}, {"count", mesh.points.size()}, {"type", "VEC3"}},
            {{"componentType", index_type},
             {"count", 3 * mesh.triangles.size()},
             {"type", "SCALAR"}}})}};
  return gltf;
}

}  // namespace

std::string ObjText(const PlainMesh& mesh) {
  std::ostringstream text = Text();
  text << "# made by a test\nmtllib nothing.mtl\no ground\n";
  for (const auto& [x, y, z] : mesh.points) text << "v " << x << " " << y << " " << z << "\n";
  for (const auto& [a, b, c] : mesh.triangles) {
    text << "f " << a + 1 << " " << b + 1 << " " << c + 1 << "\n";
  }
  return text.str();
}

std::string PlyText(const PlainMesh& mesh) {
  std::ostringstream text = Text();
  text << PlyHead(mesh, "ascii");
  for (const auto& [x, y, z] : mesh.points) text << x << " " << y << " " << z << " 7\n";
  for (const auto& [a, b, c] : mesh.triangles) text << "3 " << a << " " << b << " " << c << "\n";
  return text.str();
}

std::string PlyBytes(const PlainMesh& mesh, bool big_endian) {
  std::string bytes = PlyHead(mesh, big_endian ? "binary_big_endian" : "binary_little_endian");
  for (const auto& p : mesh.points) {
    for (const double x : p) Put(bytes, x, big_endian);
    Put(bytes, std::uint8_t{7});
  }
  for (const auto& t : mesh.triangles) {
    Put(bytes, std::uint8_t{3});
    for (const std::uint32_t v : t) Put(bytes, v, big_endian);
  }
  return bytes;
}

std::string StlText(const PlainMesh& mesh) {
  std::ostringstream text = Text();
  text << "solid ground\n";
  for (const auto& t : mesh.triangles) {
    text << " facet normal 0 0 1\n  outer loop\n";
    for (const std::uint32_t v : t) {
      const auto& [x, y, z] = mesh.points[v];
      text << "   vertex " << x << " " << y << " " << z << "\n";
    }
    text << "  endloop\n endfacet\n";
  }
  text << "endsolid ground\n";
  return text.str();
}

std::string StlBytes(const PlainMesh& mesh) {
  std::string bytes = "solid, says many a binary file";
  bytes.resize(80, ' ');
  Put(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    for (const float n : {0.0F, 0.0F, 1.0F}) Put(bytes, n);
    for (const std::uint32_t v : t) {
      for (const double x : mesh.points[v]) Put(bytes, static_cast<float>(x));
    }
    Put(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string DracoText(const PlainMesh& mesh, bool edgebreaker) {
  draco::Mesh draco_mesh;
  draco_mesh.set_num_points(static_cast<std::uint32_t>(mesh.points.size()));
  draco::GeometryAttribute attribute;
  attribute.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
  const int id =
      draco_mesh.AddAttribute(attribute, true, static_cast<std::uint32_t>(mesh.points.size()));
  for (std::uint32_t i = 0; i < mesh.points.size(); ++i) {
    const std::array<float, 3> p = {static_cast<float>(mesh.points[i][0]),
                                    static_cast<float>(mesh.points[i][1]),
                                    static_cast<float>(mesh.points[i][2])};
    draco_mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), p.data());
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    draco_mesh.AddFace({draco::PointIndex(a), draco::PointIndex(b), draco::PointIndex(c)});
  }
  draco::Encoder encoder;
  encoder.SetEncodingMethod(edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING
                                        : draco::MESH_SEQUENTIAL_ENCODING);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeMeshToBuffer(draco_mesh, &buffer).ok()) throw std::runtime_error("Draco");
  return {buffer.data(), buffer.size()};
}

TestGltf PlainGltf(const PlainMesh& mesh) {
  TestGltf gltf = Frame(mesh, 5126, 5125);
  std::string positions;
  for (const auto& p : mesh.points) {
    for (const double x : p) Put(positions, static_cast<float>(x));
  }
  std::string indices;
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) Put(indices, v);
  }
  gltf.json["accessors"][0]["bufferView"] = AddView(gltf, positions);
  gltf.json["accessors"][1]["bufferView"] = AddView(gltf, indices);
  return gltf;
}

TestGltf DracoGltf(const PlainMesh& mesh) {
  TestGltf gltf = Frame(mesh, 5126, 5125);
  const std::size_t view = AddView(gltf, DracoText(mesh, true));
  gltf.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view}, {"attributes", {{"POSITION", 0}}}};
  gltf.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  gltf.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  return gltf;
}

TestGltf MeshoptGltf(const PlainMesh& mesh) {
  TestGltf gltf = Frame(mesh, 5122, 5125);
  constexpr std::size_t kStride = 8;  // three numbers of 16 bits, and two bytes of padding
  std::string positions;
  for (const auto& p : mesh.points) {
    for (const double x : p) Put(positions, static_cast<std::int16_t>(x));
    Put(positions, std::int16_t{0});
  }
  std::vector<unsigned> indices;
  for (const auto& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
  std::vector<unsigned char> vertices(meshopt_encodeVertexBufferBound(mesh.points.size(), kStride));
  vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), positions.data(),
                                             mesh.points.size(), kStride));
  std::vector<unsigned char> corners(
      meshopt_encodeIndexBufferBound(indices.size(), mesh.points.size()));
  corners.resize(
      meshopt_encodeIndexBuffer(corners.data(), corners.size(), indices.data(), indices.size()));
  const auto add = [&](const std::vector<unsigned char>& bytes, Json about) {
    const std::size_t view = AddView(gltf, std::string(bytes.begin(), bytes.end()));
    about["buffer"] = 0;
    about["byteOffset"] = gltf.json["bufferViews"][view]["byteOffset"];
    about["byteLength"] = bytes.size();
    gltf.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"] = about;
    return view;
  };
  gltf.json["accessors"][0]["bufferView"] = add(
      vertices, {{"byteStride", kStride}, {"count", mesh.points.size()}, {"mode", "ATTRIBUTES"}});
  gltf.json["accessors"][1]["bufferView"] =
      add(corners, {{"byteStride", 4}, {"count", indices.size()}, {"mode", "TRIANGLES"}});
  gltf.json["extensionsRequired"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
  return gltf;
}

std::string GlbBytes(const TestGltf& gltf) {
  Json json = gltf.json;
  json["buffers"] = Json::array({{{"byteLength", gltf.buffer.size()}}});
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string buffer = gltf.buffer;
  buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
  std::string glb = "glTF";
  Put(glb, std::uint32_t{2});
  Put(glb, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + buffer.size()));
  Put(glb, static_cast<std::uint32_t>(text.size()));
  glb += "JSON" + text;
  Put(glb, static_cast<std::uint32_t>(buffer.size()));
  glb += std::string("BIN\0", 4) + buffer;
  return glb;
}

std::string EmbeddedText(const TestGltf& gltf) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string digits;
  for (std::size_t i = 0; i < gltf.buffer.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool there = i + k < gltf.buffer.size();
      bits = bits << 8U | (there ? static_cast<unsigned char>(gltf.buffer[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool there = i + k <= gltf.buffer.size();
      digits += there ? kDigits[bits >> (18 - 6 * k) & 63U] : '=';
    }
  }
  Json json = gltf.json;
  json["buffers"] = Json::array({{{"byteLength", gltf.buffer.size()},
                                  {"uri", "data:application/octet-stream;base64," + digits}}});
  return json.dump();
}

}  // namespace farhorizon
