#include "tests/support/engine_agreement.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <optional>
#include <sstream>
#include <vector>

#include "tests/oracles/horizon_brute_force.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/shrink.h"

namespace farhorizon {
namespace {

/// The edges of one engine, or why there are none.
struct Answer {
  std::optional<std::vector<Edge>> edges;  ///< nullopt: it documented why not
  std::string offence;
};

Answer AdaptiveAnswer(const Terrain& terrain, const Engines& engines) {
  Result<Horizon> horizon = engines.adaptive(terrain);
  if (!horizon) {
    return {{}, "the adaptive engine says: " + horizon.error().message};
  }
  Answer answer;
  answer.edges.emplace();
  for (const HorizonEdge& e : horizon->edges) {
    answer.edges->push_back(e.edge);
    if (!e.witness.exact || WitnessHolds(terrain, e.edge, e.witness)) continue;
    std::ostringstream out;
    out << "a witness does not hold: edge " << e.edge.a << '-' << e.edge.b << " t " << e.witness.t
        << " direction " << e.witness.dc << ' ' << e.witness.dr;
    answer.offence = out.str();
  }
  return answer;
}

/// What is wrong with the superset that a small budget leaves.
std::string ApproximateOffence(const Terrain& terrain, const std::vector<Edge>& exact,
                               const Engines& engines) {
  Result<Horizon> horizon = engines.approximate(terrain);
  if (!horizon) {
    return "approximating, the adaptive engine says: " + horizon.error().message;
  }
  std::vector<Edge> kept;
  std::vector<Edge> decided;
  for (const HorizonEdge& e : horizon->edges) {
    kept.push_back(e.edge);
    if (!e.undecided) decided.push_back(e.edge);
    if (!e.undecided && e.witness.exact && !WitnessHolds(terrain, e.edge, e.witness)) {
      return "approximating, a witness does not hold";
    }
  }
  if (!std::includes(kept.begin(), kept.end(), exact.begin(), exact.end())) {
    return "the approximate set is no superset";
  }
  if (!std::includes(exact.begin(), exact.end(), decided.begin(), decided.end())) {
    return "the approximate set has decided for an edge that is not on the horizon";
  }
  return {};
}

Answer KineticAnswer(const Terrain& terrain, const Engines& engines) {
  Result<KineticHorizon> horizon = engines.kinetic(terrain);
  if (horizon) return {horizon->edges, {}};
  if (horizon.error().kind == "kinetic-too-large") return {};
  return {{}, "the kinetic engine says: " + horizon.error().message};
}

void NameEdges(const char* what, const std::vector<Edge>& a, const std::vector<Edge>& b,
               std::ostream& out) {
  std::vector<Edge> rest;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(rest));
  if (rest.empty()) return;
  out << what;
  for (const Edge e : rest) out << ' ' << e.a << '-' << e.b;
}

std::string Difference(const char* left, const Answer& a, const char* right, const Answer& b) {
  if (!a.edges || !b.edges || *a.edges == *b.edges) return {};
  std::ostringstream out;
  out << left << " and " << right << " differ;";
  NameEdges(" only the former:", *a.edges, *b.edges, out);
  NameEdges(" only the latter:", *b.edges, *a.edges, out);
  return out.str();
}

std::string OffenceOn(const Terrain& terrain, const Engines& engines) {
  const Answer adaptive = AdaptiveAnswer(terrain, engines);
  const Answer kinetic = KineticAnswer(terrain, engines);
  for (const Answer* answer : {&adaptive, &kinetic}) {
    if (!answer->offence.empty()) return answer->offence;
  }
  if (terrain.post_count() <= engines.posts_by_definition) {
    const Answer definition{HorizonByBruteForce(terrain), {}};
    std::string offence =
        Difference("the adaptive engine", adaptive, "the definition", definition) +
        Difference("the kinetic engine", kinetic, "the definition", definition);
    if (!offence.empty()) return offence;
  }
  std::string offence = Difference("the adaptive engine", adaptive, "the kinetic engine", kinetic);
  if (!offence.empty() || !adaptive.edges) return offence;
  return ApproximateOffence(terrain, *adaptive.edges, engines);
}

}  // namespace

std::string EngineOffence(const Dem& dem, const Engines& engines) {
  const Result<Terrain> terrain = Terrain::Build(dem);
  if (!terrain) return {};
  try {
    return OffenceOn(*terrain, engines);
  } catch (const std::exception& broken) {
    return std::string("it throws: ") + broken.what();
  }
}

Dem SmallestOffender(const Dem& dem, const Engines& engines) {
  return Shrink(dem, [&engines](const Dem& d) { return !EngineOffence(d, engines).empty(); });
}

std::string SmallestOffence(const Dem& dem, const Engines& engines) {
  const Dem small = SmallestOffender(dem, engines);
  return EngineOffence(small, engines) + "\non this DEM, the smallest found:\n" + DrawAscii(small);
}

}  // namespace farhorizon
