#include "service/handlers/result_wishes.h"

#include <nlohmann/json.hpp>

namespace farhorizon {

std::string WriteResultWishes(const ResultWishes& wishes) {
  if (!wishes.raw && !wishes.outputs) return "";
  nlohmann::json document = {{"response", wishes.raw ? "raw" : "document"}};
  if (wishes.outputs) {
    nlohmann::json& outputs = document["outputs"] = nlohmann::json::object();
    for (const auto& [name, how] : *wishes.outputs) {
      outputs[name] = how == Transmission::kValue ? "value" : "reference";
    }
  }
  return document.dump();
}

ResultWishes ReadResultWishes(const std::string& text) {
  const nlohmann::json document = nlohmann::json::parse(text, nullptr, false);
  if (!document.is_object()) return {};
  ResultWishes wishes;
  wishes.raw = document.value("response", nlohmann::json()) == "raw";
  const auto outputs = document.find("outputs");
  if (outputs == document.end()) return wishes;
  wishes.outputs.emplace();
  for (const auto& [name, how] : outputs->items()) {
    (*wishes.outputs)[name] = how == "value" ? Transmission::kValue : Transmission::kReference;
  }
  return wishes;
}

}  // namespace farhorizon
