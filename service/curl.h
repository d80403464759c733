#pragma once

#include <curl/curl.h>
#include <string>

#include "core/base/result.h"

namespace farhorizon {

/// A transfer by libcurl, and the connection that it keeps. Threads: one at a time.
class CurlHandle {
 public:
  CurlHandle();
  ~CurlHandle() { ::curl_easy_cleanup(curl_); }
  CurlHandle(const CurlHandle&) = delete;
  CurlHandle& operator=(const CurlHandle&) = delete;
  [[nodiscard]] CURL* get() const { return curl_; }

  /// Requires: libcurl knows the option, which may be what shuts a transfer in.
  template <typename Value>
  void Set(CURLoption option, Value value) {
    Check(::curl_easy_setopt(curl_, option, value) == CURLE_OK, "libcurl knows the option");
  }

 private:
  CURL* curl_;
};

/// Lines that libcurl takes, such as fields of a head.
class CurlList {
 public:
  CurlList() = default;
  ~CurlList() { ::curl_slist_free_all(list_); }
  CurlList(const CurlList&) = delete;
  CurlList& operator=(const CurlList&) = delete;
  void Add(const std::string& line);
  /// nullptr where there are none.
  [[nodiscard]] curl_slist* get() const { return list_; }

 private:
  curl_slist* list_ = nullptr;
};

}  // namespace farhorizon
