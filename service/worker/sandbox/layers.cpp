#include "service/worker/sandbox/layers.h"

#include <array>
#include <sstream>
#include <string_view>

namespace farhorizon {

namespace {

struct Layer {
  std::string_view name;
  bool (*active)(const SandboxLayers& layers);
  std::string_view remedy;
};

constexpr std::array<Layer, 4> kLayers = {{
    {"namespaces", [](const SandboxLayers& layers) { return layers.namespaces; },
     "allow unprivileged user namespaces (sysctl user.max_user_namespaces, "
     "kernel.unprivileged_userns_clone); in a container, a seccomp profile that lets clone pass"},
    {"private-root", [](const SandboxLayers& layers) { return layers.private_root; },
     "needs the layer namespaces, and a kernel of 5.12 or later that lets them mount"},
    {"landlock", [](const SandboxLayers& layers) { return layers.landlock > 0; },
     "use a kernel of 5.13 or later with landlock among its security modules (lsm=landlock,…)"},
    {"seccomp", [](const SandboxLayers& layers) { return layers.seccomp; },
     "use a kernel with CONFIG_SECCOMP_FILTER"},
}};

const Layer* Find(std::string_view name) {
  for (const Layer& layer : kLayers) {
    if (layer.name == name) return &layer;
  }
  return nullptr;
}

}  // namespace

std::vector<std::string> NamesOf(const SandboxLayers& layers) {
  std::vector<std::string> names;
  for (const Layer& layer : kLayers) {
    if (layer.active(layers)) names.emplace_back(layer.name);
  }
  return names;
}

Status CheckSandbox(const std::string& required, const SandboxLayers& layers) {
  if (required == "none") return Ok{};
  std::istringstream words(required == "all" ? "namespaces,private-root,landlock,seccomp"
                                             : required);
  std::string missing;
  bool any = false;
  for (std::string name; std::getline(words, name, ',');) {
    const Layer* layer = Find(name);
    if (layer == nullptr) {
      return Error{ErrorCode::kInvalidArgument,
                   "sandbox.require: \"" + name +
                       "\" is no layer; give none, all, or of namespaces, private-root, landlock "
                       "and seccomp, with commas between",
                   "invalid-config"};
    }
    any = true;
    if (layer->active(layers)) continue;
    missing.append(missing.empty() ? "" : "; ").append(name).append(": ").append(layer->remedy);
  }
  if (!any) return CheckSandbox(" ", layers);
  if (missing.empty()) return Ok{};
  return Error{ErrorCode::kIo,
               "layers of the sandbox that sandbox.require names cannot be had here: " + missing +
                   "; or leave them out of sandbox.require",
               "sandbox-missing"};
}

}  // namespace farhorizon
