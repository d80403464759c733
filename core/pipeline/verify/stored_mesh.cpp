#include "core/pipeline/verify/stored_mesh.h"

#include <utility>

#include "core/io/file.h"

namespace farhorizon {

std::optional<std::vector<std::uint8_t>> LoadBytes(const std::filesystem::path& path,
                                                   Claims& claims) {
  Result<std::string> text = ReadFile(path);
  if (!text) {
    claims.Add(false, path.filename().string() + ": " + text.error().message);
    return std::nullopt;
  }
  return std::vector<std::uint8_t>(text->begin(), text->end());
}

std::optional<DecodedMesh> DecodeStored(const std::string& name,
                                        const std::vector<std::uint8_t>& bytes, Claims& claims) {
  Result<DecodedMesh> decoded = DecodeDraco(bytes);
  claims.Add(decoded.has_value(),
             name + " decodes as Draco" + (decoded ? "" : ": " + decoded.error().message));
  if (!decoded) return std::nullopt;
  return *std::move(decoded);
}

}  // namespace farhorizon
