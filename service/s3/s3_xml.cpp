// pugixml expands no entity of a document's own, fetches nothing, and does not recurse: an answer
// of kMostAnswerBytes costs no more than some times its own bytes.
#include "service/s3/s3_xml.h"

#include <pugixml.hpp>

namespace farhorizon {

namespace {

// The root of an answer; empty where it is no XML, or has another root.
pugi::xml_node Root(pugi::xml_document& document, const std::string& body, const char* name) {
  if (!document.load_buffer(body.data(), body.size())) return {};
  return document.child(name);
}

}  // namespace

std::optional<S3Fault> ReadS3Fault(const std::string& body) {
  pugi::xml_document document;
  const pugi::xml_node root = Root(document, body, "Error");
  if (root) return S3Fault{root.child_value("Code"), root.child_value("Message")};
  // What DeleteObjects could not remove.
  const pugi::xml_node left = document.child("DeleteResult").child("Error");
  if (left) return S3Fault{left.child_value("Code"), left.child_value("Message")};
  return std::nullopt;
}

std::optional<S3Page> ReadS3Page(const std::string& body) {
  pugi::xml_document document;
  const pugi::xml_node root = Root(document, body, "ListBucketResult");
  if (!root) return std::nullopt;
  S3Page page;
  for (const pugi::xml_node entry : root.children("Contents")) {
    page.keys.emplace_back(entry.child_value("Key"));
  }
  page.more = std::string(root.child_value("IsTruncated")) == "true";
  return page;
}

std::string ReadS3UploadId(const std::string& body) {
  pugi::xml_document document;
  return Root(document, body, "InitiateMultipartUploadResult").child_value("UploadId");
}

}  // namespace farhorizon
