#include "service/s3/s3_credentials.h"

#include <sstream>
#include <sys/stat.h>
#include <utility>

#include "core/io/file.h"
#include "service/text_list.h"

namespace farhorizon {

namespace {

constexpr std::uintmax_t kLargestCredentials = 1 << 20;

constexpr const char* kSpaces = " \t\r";

Error NoKeys(const std::string& why) {
  return {ErrorCode::kInvalidArgument,
          why +
              "; set AWS_ACCESS_KEY_ID and AWS_SECRET_ACCESS_KEY, or name a file of credentials "
              "(store.s3Credentials)",
          "invalid-config"};
}

S3Keys KeysOf(const std::string& text, const std::string& profile) {
  S3Keys keys;
  std::istringstream lines(text);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    line = Trimmed(line, kSpaces);
    if (!line.empty() && line.front() == '[') inside = line == "[" + profile + "]";
    const std::size_t equals = line.find('=');
    if (!inside || equals == std::string::npos) continue;
    const std::string_view name = Trimmed(std::string_view(line).substr(0, equals), kSpaces);
    const std::string_view value = Trimmed(std::string_view(line).substr(equals + 1), kSpaces);
    if (name == "aws_access_key_id") keys.id = value;
    if (name == "aws_secret_access_key") keys.secret = value;
    if (name == "aws_session_token") keys.token = value;
  }
  return keys;
}

}  // namespace

S3Credentials::S3Credentials(std::filesystem::path file,
                             std::map<std::string, std::string> environment)
    : file_(std::move(file)), environment_(std::move(environment)) {
  const S3Keys keys{environment_["AWS_ACCESS_KEY_ID"], environment_["AWS_SECRET_ACCESS_KEY"],
                    environment_["AWS_SESSION_TOKEN"]};
  if (!file_.empty()) return;
  if (!keys.id.empty() && !keys.secret.empty()) {
    read_ = keys;
  } else {
    file_ = environment_["AWS_SHARED_CREDENTIALS_FILE"];
  }
}

Result<S3Keys> S3Credentials::Current() {
  const std::lock_guard lock(mutex_);
  if (file_.empty()) {
    if (!read_) return NoKeys("there are no keys for the storage of objects");
    return *read_;
  }
  struct stat info {};
  if (::stat(file_.c_str(), &info) != 0) {
    return NoKeys("the file of credentials " + file_.string() + " is not there");
  }
  const bool same =
      info.st_mtim.tv_sec == modified_.tv_sec && info.st_mtim.tv_nsec == modified_.tv_nsec;
  if (read_ && same) return *read_;
  Result<std::string> text = ReadFile(file_, kLargestCredentials);
  if (!text) return NoKeys("the file of credentials " + file_.string() + " cannot be read");
  const std::string profile =
      environment_["AWS_PROFILE"].empty() ? "default" : environment_["AWS_PROFILE"];
  const S3Keys keys = KeysOf(*text, profile);
  if (keys.id.empty() || keys.secret.empty()) {
    return NoKeys("the file of credentials " + file_.string() + " has no section [" + profile +
                  "] with aws_access_key_id and aws_secret_access_key");
  }
  read_ = keys;
  modified_ = info.st_mtim;
  return keys;
}

}  // namespace farhorizon
