// libFuzzer's target: the reader of multipart forms. The first byte is the size of the pieces into
// which the rest is cut; cut or not, the parts and the verdict are the same.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "service/handlers/multipart.h"

namespace {

struct Part {
  std::string name;
  std::optional<std::string> filename;
  std::string data;

  friend bool operator==(const Part&, const Part&) = default;
};

struct Form {
  std::vector<Part> parts;
  std::string fault;  // empty: sound

  friend bool operator==(const Form&, const Form&) = default;
};

Form Read(std::string_view body, std::size_t piece) {
  Form form;
  farhorizon::MultipartParser parser("XX",
                                     {[&](const farhorizon::PartHead& head) -> farhorizon::Status {
                                        form.parts.push_back({head.name, head.filename, ""});
                                        return farhorizon::Ok{};
                                      },
                                      [&](std::string_view data) -> farhorizon::Status {
                                        form.parts.back().data += data;
                                        return farhorizon::Ok{};
                                      }});
  farhorizon::Status status = farhorizon::Ok{};
  for (; status && !body.empty(); body.remove_prefix(std::min(piece, body.size()))) {
    status = parser.Feed(body.substr(0, piece));
  }
  if (status) status = parser.Finish();
  if (!status) form.fault = status.error().message;
  return form;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const std::string text(data + 1, data + size);
  const Form whole = Read(text, text.size());
  const Form cut = Read(text, 1 + data[0] % 64U);
  if (whole == cut) return 0;
  std::cerr << "whole: " << whole.parts.size() << " parts, fault '" << whole.fault
            << "'; cut: " << cut.parts.size() << " parts, fault '" << cut.fault << "'" << std::endl;
  std::abort();
}
