#include "service/curl.h"

namespace farhorizon {

CurlHandle::CurlHandle() {
  static const CURLcode ready = ::curl_global_init(CURL_GLOBAL_DEFAULT);
  Check(ready == CURLE_OK, "libcurl can be used");
  curl_ = ::curl_easy_init();
  Check(curl_ != nullptr, "there is memory for a transfer");
}

void CurlList::Add(const std::string& line) {
  curl_slist* longer = ::curl_slist_append(list_, line.c_str());
  Check(longer != nullptr, "there is memory for a line");
  list_ = longer;
}

}  // namespace farhorizon
