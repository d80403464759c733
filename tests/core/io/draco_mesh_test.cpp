#include "core/io/draco_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <set>

#include <draco/attributes/attribute_quantization_transform.h>
#include <draco/compression/decode.h>
#include <gtest/gtest.h>

#include "tests/support/local_meshes.h"

namespace farhorizon {
namespace {

DecodedMesh Decode(const LocalMesh& mesh, const QuantizationLattice& lattice) {
  Result<std::vector<std::uint8_t>> bytes = EncodeDraco(mesh, lattice);
  if (!bytes) throw std::runtime_error(bytes.error().message);
  Result<DecodedMesh> decoded = DecodeDraco(*bytes);
  if (!decoded) throw std::runtime_error(decoded.error().message);
  return *decoded;
}

LocalMesh RoundTrip(const LocalMesh& mesh, const QuantizationLattice& lattice) {
  return Decode(mesh, lattice).mesh;
}

// The greatest angle between a decoded normal and the one encoded for its post, degrees.
double WorstNormalDeg(const LocalMesh& decoded, const LocalMesh& mesh) {
  std::map<std::uint32_t, UnitNormal> by_post;
  for (std::size_t i = 0; i < mesh.posts.size(); ++i) by_post[mesh.posts[i]] = mesh.normals[i];
  double worst = 0;
  for (std::size_t i = 0; i < decoded.posts.size(); ++i) {
    const UnitNormal& n = by_post.at(decoded.posts[i]);
    const UnitNormal& m = decoded.normals[i];
    const double chord = std::hypot(n[0] - m[0], n[1] - m[1], n[2] - m[2]);
    worst = std::max(worst, 2 * std::asin(chord / 2) * 180 / std::acos(-1.0));
  }
  return worst;
}

// The triangles by their vertices' posts, each turned so that its least post comes first.
std::multiset<std::array<std::uint32_t, 3>> ByPost(const LocalMesh& mesh) {
  std::multiset<std::array<std::uint32_t, 3>> triangles;
  for (const auto& t : mesh.triangles) {
    std::array<std::uint32_t, 3> s = {mesh.posts[t[0]], mesh.posts[t[1]], mesh.posts[t[2]]};
    std::ranges::rotate(s, std::ranges::min_element(s));
    triangles.insert(s);
  }
  return triangles;
}

void ExpectSamePositions(const LocalMesh& decoded, const LocalMesh& mesh,
                         const QuantizationLattice& lattice) {
  std::map<std::uint32_t, Enu> by_post;
  for (std::size_t i = 0; i < mesh.posts.size(); ++i) {
    by_post[mesh.posts[i]] = SnapToLattice(mesh.positions[i], lattice);
  }
  for (std::size_t i = 0; i < decoded.posts.size(); ++i) {
    const auto found = by_post.find(decoded.posts[i]);
    ASSERT_NE(found, by_post.end());
    EXPECT_EQ(decoded.positions[i].east, found->second.east);
    EXPECT_EQ(decoded.positions[i].north, found->second.north);
    EXPECT_EQ(decoded.positions[i].up, found->second.up);
  }
}

TEST(Draco, DecodesToTheLatticeExactlyWithPostsAndWindings) {
  const LocalMesh mesh = HillyGrid(61, 43, 27.3);
  for (const double wanted : {0.03, 0.5, 10.0}) {
    const QuantizationLattice lattice = ChooseLattice(mesh.positions, wanted);
    const LocalMesh decoded = RoundTrip(mesh, lattice);
    EXPECT_EQ(decoded.positions.size(), mesh.positions.size());
    EXPECT_EQ(ByPost(decoded), ByPost(mesh));
    ExpectSamePositions(decoded, mesh, lattice);
  }
}

TEST(Draco, ItsOwnQuantizationHasOriginZeroAndStepOne) {
  // Clients that apply it twice, and those that do not know the metadata, get lattice numbers.
  const LocalMesh mesh = HillyGrid(61, 43, 27.3);
  const QuantizationLattice lattice = ChooseLattice(mesh.positions, 0.5);
  const std::vector<std::uint8_t> bytes = *EncodeDraco(mesh, lattice);
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  decoder.SetSkipAttributeTransform(draco::GeometryAttribute::POSITION);
  const auto decoded = std::move(decoder.DecodeMeshFromBuffer(&buffer)).value();
  draco::AttributeQuantizationTransform transform;
  ASSERT_TRUE(transform.InitFromAttribute(*decoded->GetAttributeByUniqueId(0)));
  EXPECT_EQ(transform.min_values(), std::vector<float>({0, 0, 0}));
  EXPECT_EQ(transform.quantization_bits(), lattice.bits);
  EXPECT_EQ(transform.range(), std::ldexp(1.0F, lattice.bits) - 1);
}

TEST(Draco, TheMetadataNameTheLattice) {
  const LocalMesh mesh = HillyGrid(61, 43, 27.3);
  for (const double wanted : {0.03, 0.5, 10.0}) {
    const QuantizationLattice lattice = ChooseLattice(mesh.positions, wanted);
    const QuantizationLattice decoded = Decode(mesh, lattice).lattice;
    EXPECT_EQ(decoded.origin, lattice.origin);
    EXPECT_EQ(decoded.step_m, lattice.step_m);
    EXPECT_EQ(decoded.bits, lattice.bits);
  }
}

TEST(Draco, NumbersOfTheGreatestLatticeDecodeExactly) {
  // One of each eight numbers of 19 bits on one axis, the first and the last included, in a strip.
  constexpr std::uint32_t kEnd = 1U << 19U;
  static_assert(kMaxLatticeBits == 19);
  LocalMesh mesh;
  for (std::uint32_t i = 0; i < kEnd / 8; ++i) {
    const std::uint32_t number = i % 2 == 0 ? 8 * i : 8 * i + 7;
    mesh.positions.push_back({number / 64.0 - 4000, i % 2 * 100.0, (kEnd - 1 - number) / 64.0});
    mesh.posts.push_back(i);
    mesh.normals.push_back({0, 0, 1});
    if (i >= 2) mesh.triangles.push_back({i - 2, i - 1, i});
  }
  const QuantizationLattice lattice = {.origin = {-4000, 0, 0}, .step_m = 1 / 64.0, .bits = 19};
  ExpectSamePositions(RoundTrip(mesh, lattice), mesh, lattice);
}

TEST(Draco, PostsMayBeLeftOut) {
  const LocalMesh mesh = HillyGrid(61, 43, 27.3);
  const QuantizationLattice lattice = ChooseLattice(mesh.positions, 0.5);
  const std::vector<std::uint8_t> with = *EncodeDraco(mesh, lattice);
  const std::vector<std::uint8_t> without = *EncodeDraco(mesh, lattice, DracoPosts::kLeftOut);
  EXPECT_LT(without.size(), with.size());
  const DecodedMesh decoded = *DecodeDraco(without);
  EXPECT_TRUE(decoded.mesh.posts.empty());
  EXPECT_EQ(decoded.mesh.positions.size(), mesh.positions.size());
  EXPECT_EQ(decoded.mesh.triangles.size(), mesh.triangles.size());
  EXPECT_EQ(decoded.mesh.normals.size(), mesh.normals.size());
  EXPECT_EQ(decoded.lattice.step_m, lattice.step_m);
}

TEST(Draco, NormalsComeBackWithinADegree) {
  const LocalMesh mesh = HillyGrid(61, 43, 27.3);
  const LocalMesh decoded = RoundTrip(mesh, ChooseLattice(mesh.positions, 0.5));
  EXPECT_EQ(decoded.positions.size(), mesh.positions.size());  // no seams: no vertex is split
  EXPECT_LT(WorstNormalDeg(decoded, mesh), 1);
}

TEST(Draco, NormalsOfAnyDirectionPointUpwardsStill) {
  LocalMesh mesh = HillyGrid(120, 120, 10);
  std::mt19937 random(31);
  std::uniform_real_distribution<double> turn(0, 2 * std::acos(-1.0));
  std::uniform_real_distribution<double> rise(kLeastNormalUp, 1);
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    const double up = i % 2 == 0 ? kLeastNormalUp : rise(random);  // half as steep as allowed
    const double azimuth = turn(random);
    const double level = std::sqrt(1 - up * up);
    mesh.normals[i] = {level * std::sin(azimuth), level * std::cos(azimuth), up};
  }
  const LocalMesh decoded = RoundTrip(mesh, ChooseLattice(mesh.positions, 0.1));
  EXPECT_EQ(decoded.positions.size(), mesh.positions.size());
  EXPECT_LT(WorstNormalDeg(decoded, mesh), 1);
  for (const UnitNormal& n : decoded.normals) {
    EXPECT_GT(n[2], 0);
    EXPECT_NEAR(std::hypot(n[0], n[1], n[2]), 1, 1e-6);
  }
}

TEST(Draco, ANormalThatIsNoDirectionIsOurBug) {
  LocalMesh mesh = HillyGrid(3, 3, 10);
  const QuantizationLattice lattice = ChooseLattice(mesh.positions, 0.1);
  mesh.normals[4] = {0, 0, 2};
  EXPECT_THROW(static_cast<void>(EncodeDraco(mesh, lattice)), InternalError);
  mesh.normals.pop_back();
  EXPECT_THROW(static_cast<void>(EncodeDraco(mesh, lattice)), InternalError);
}

// Draco makes tables as long as the greatest number: minutes under the sanitizers.
TEST(DracoLong, AnyNumberBelowTheLimitIsCarriedAsSource) {
  LocalMesh mesh = HillyGrid(9, 9, 10);
  std::mt19937 random(17);
  for (std::uint32_t& post : mesh.posts) post = static_cast<std::uint32_t>(random()) >> 4U;
  mesh.posts[3] = 0;
  mesh.posts[4] = kMaxPost;
  const LocalMesh decoded = RoundTrip(mesh, ChooseLattice(mesh.positions, 0.1));
  EXPECT_EQ(ByPost(decoded), ByPost(mesh));
}

TEST(Draco, VerticesOfOnePlaceStayApart) {
  // Coarse enough that many neighbours fall on one lattice position: nothing is merged.
  const LocalMesh mesh = HillyGrid(30, 30, 1);
  const QuantizationLattice lattice = ChooseLattice(mesh.positions, 8);
  const LocalMesh decoded = RoundTrip(mesh, lattice);
  EXPECT_EQ(decoded.positions.size(), mesh.positions.size());
  EXPECT_EQ(ByPost(decoded), ByPost(mesh));
  ExpectSamePositions(decoded, mesh, lattice);
}

TEST(Draco, HolesAndVerticesBetweenFansSurvive) {
  // Holes on either side of a vertex leave it with two fans of triangles: it comes back twice.
  const LocalMesh mesh = HillyGrid(24, 24, 10, [](std::uint32_t c, std::uint32_t r) {
    return (c * 7 + r * 5) % 11 == 0 || (c == 3 && r < 20) || (r == 22 && (c == 9 || c == 11));
  });
  const QuantizationLattice lattice = ChooseLattice(mesh.positions, 0.1);
  const LocalMesh decoded = RoundTrip(mesh, lattice);
  EXPECT_GT(decoded.positions.size(), mesh.positions.size());
  EXPECT_EQ(ByPost(decoded), ByPost(mesh));
  ExpectSamePositions(decoded, mesh, lattice);
  EXPECT_LT(WorstNormalDeg(decoded, mesh), 1);
}

TEST(Draco, SeveralPiecesAndASingleTriangleSurvive) {
  LocalMesh mesh = HillyGrid(20, 6, 10, [](std::uint32_t c, std::uint32_t) { return c % 4 == 3; });
  EXPECT_EQ(ByPost(RoundTrip(mesh, ChooseLattice(mesh.positions, 0.1))), ByPost(mesh));
  mesh = {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
          .posts = {7, 8, 9},
          .normals = {{0, 0, 1}, {0.6, 0, 0.8}, {0, -0.6, 0.8}},
          .triangles = {{0, 1, 2}}};
  EXPECT_EQ(ByPost(RoundTrip(mesh, ChooseLattice(mesh.positions, 0.1))), ByPost(mesh));
}

TEST(Draco, SameMeshSameBytes) {
  const LocalMesh mesh = HillyGrid(33, 33, 10);
  const QuantizationLattice lattice = ChooseLattice(mesh.positions, 0.1);
  EXPECT_EQ(*EncodeDraco(mesh, lattice), *EncodeDraco(mesh, lattice));
}

TEST(Draco, RefusesMeshesThatItWouldChange) {
  const LocalMesh good = HillyGrid(3, 3, 10);
  const QuantizationLattice lattice = ChooseLattice(good.positions, 0.1);
  const auto kind_of = [&](const LocalMesh& mesh) {
    Result<std::vector<std::uint8_t>> bytes = EncodeDraco(mesh, lattice);
    return bytes ? "encoded" : std::string(bytes.error().kind);
  };
  EXPECT_EQ(kind_of(good), "encoded");
  LocalMesh bad = good;
  bad.triangles.clear();
  EXPECT_EQ(kind_of(bad), "bad-mesh");
  bad = good;
  bad.triangles.push_back({0, 1, 1});
  EXPECT_EQ(kind_of(bad), "bad-mesh");
  bad = good;
  bad.triangles[0][0] = 99;
  EXPECT_EQ(kind_of(bad), "bad-mesh");
  bad = good;
  bad.posts[2] = kMaxPost + 1;
  EXPECT_EQ(kind_of(bad), "bad-mesh");
  bad = good;
  bad.positions.push_back({0, 0, 400});
  bad.posts.push_back(5);
  bad.normals.push_back({0, 0, 1});
  EXPECT_EQ(kind_of(bad), "bad-mesh");
}

TEST(Draco, APositionOutsideTheLatticeIsOurBug) {
  const LocalMesh mesh = HillyGrid(3, 3, 10);
  QuantizationLattice lattice = ChooseLattice(mesh.positions, 0.1);
  lattice.origin[0] += 100 * lattice.step_m;
  EXPECT_THROW(static_cast<void>(EncodeDraco(mesh, lattice)), InternalError);
}

TEST(DecodeDraco, RefusesWhatIsNoBitstream) {
  EXPECT_EQ(DecodeDraco({}).error().kind, "bad-draco");
  EXPECT_EQ(DecodeDraco({'D', 'R', 'A', 'C', 'O', 2, 2, 1, 1}).error().kind, "bad-draco");
  const LocalMesh mesh = HillyGrid(9, 9, 10);
  std::vector<std::uint8_t> bytes = *EncodeDraco(mesh, ChooseLattice(mesh.positions, 0.1));
  bytes.resize(bytes.size() / 2);
  EXPECT_EQ(DecodeDraco(bytes).error().kind, "bad-draco");
}

TEST(DecodeDraco, RefusesALatticeThatIsNone) {
  const LocalMesh mesh = HillyGrid(9, 9, 10);
  const std::vector<std::uint8_t> good = *EncodeDraco(mesh, ChooseLattice(mesh.positions, 0.25));
  const std::string name = "lattice_step";
  const auto at = std::ranges::search(good, name).end();
  ASSERT_NE(at, good.end());
  const std::ptrdiff_t value = at - good.begin() + 1;  // after a byte that tells its length
  const auto with_step = [&](double step) {
    std::vector<std::uint8_t> bytes = good;
    std::memcpy(bytes.data() + value, &step, sizeof step);
    return DecodeDraco(bytes);
  };
  ASSERT_TRUE(with_step(0.25));
  EXPECT_EQ(with_step(0.25)->lattice.step_m, 0.25);
  for (const double step : {0.0, -0.25, 0.3, 512.0, HUGE_VAL, std::nan("")}) {
    EXPECT_EQ(with_step(step).error().kind, "bad-draco") << step;
  }
  std::vector<std::uint8_t> nameless = good;
  nameless[static_cast<std::size_t>(value - 2)] = '?';
  EXPECT_EQ(DecodeDraco(nameless).error().kind, "bad-draco");
}

}  // namespace
}  // namespace farhorizon
