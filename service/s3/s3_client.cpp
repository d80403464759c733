#include "service/s3/s3_client.h"

#include <algorithm>
#include <optional>
#include <thread>
#include <utility>

#include "service/random.h"
#include "service/s3/s3_xml.h"

namespace farhorizon {

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr int kMostTries = 4;
constexpr std::chrono::seconds kMostTime{15};
constexpr milliseconds kFirstPause{200};
constexpr std::chrono::seconds kBetweenTries{1};

bool IsAnswer(int status) {
  return (status >= 200 && status < 300) || status == 404 || status == 409 || status == 412;
}

// Of 400, the sums of a body that was changed on its way, and one that did not come in time.
bool MayPass(const S3Answer& answer, const std::string& code) {
  return answer.status == 0 || answer.status >= 500 || answer.status == 429 ||
         answer.status == 408 || code == "InternalError" || code == "SlowDown" ||
         code == "RequestTimeout" || code == "BadDigest" || code == "XAmzContentSHA256Mismatch" ||
         code == "OperationAborted" || code == "ConditionalRequestConflict";
}

}  // namespace

S3Client::S3Client(S3Location location, S3Credentials& credentials)
    : location_(std::move(location)),
      credentials_(credentials),
      transfer_(location_.url, location_.region) {}

int S3Client::TriesNow(const S3Request& request) {
  const std::lock_guard lock(mutex_);
  if (request.once) return 1;
  if (!silent_) return kMostTries;
  const auto now = steady_clock::now();
  if (now < next_try_) return 0;
  next_try_ = now + kMostTime;  // until this one is back
  return 1;
}

void S3Client::Note(bool answers) {
  const std::lock_guard lock(mutex_);
  silent_ = !answers;
  next_try_ = steady_clock::now() + kBetweenTries;
}

Result<S3Answer> S3Client::Send(const S3Request& request) {
  const int tries = TriesNow(request);
  if (tries > 0) return SendOften(request, tries);
  return Error{ErrorCode::kIo,
               "the storage of objects at " + location_.url + " did not answer a moment ago",
               "storage"};
}

Result<S3Answer> S3Client::SendOften(const S3Request& request, int tries) {
  const auto begun = steady_clock::now();
  for (int tried = 1;; ++tried) {
    Result<S3Keys> keys = credentials_.Current();
    if (!keys) return Error{ErrorCode::kIo, keys.error().message, "storage"};
    S3Answer answer = transfer_.Attempt(request, *keys);
    const std::optional<S3Fault> fault =
        answer.body.empty() ? std::nullopt : ReadS3Fault(answer.body);
    const std::string code = fault ? fault->code : "";
    const bool may_pass = MayPass(answer, code);
    // A 200 with a fault in it is no success: Amazon says so where parts could not be joined.
    const bool spoilt = answer.status / 100 == 2 && fault;
    if (IsAnswer(answer.status) && !spoilt && code != "NoSuchBucket" && !may_pass) {
      Note(true);
      return answer;
    }
    if (answer.status < 0) {
      Note(true);
      return Error{ErrorCode::kIo, request.method + " " + request.key + ": " + answer.body,
                   "storage"};
    }
    if (!may_pass || tried >= tries || steady_clock::now() - begun > kMostTime) {
      // A 500 is said by somebody: only who says nothing is left alone.
      Note(answer.status != 0);
      return ErrorOf(request, answer);
    }
    std::this_thread::sleep_for(RandomDelay(kFirstPause, kMostTime, tried - 1));
  }
}

Error S3Client::ErrorOf(const S3Request& request, const S3Answer& answer) const {
  const std::optional<S3Fault> fault = answer.status == 0 ? std::nullopt : ReadS3Fault(answer.body);
  const std::string code = fault ? fault->code : "";
  std::string why = "the storage of objects at " + location_.url;
  if (answer.status == 0) {
    why += " is out of reach (" + answer.body + "); look at it, and at store.s3Endpoint";
  } else if (code == "NoSuchBucket") {
    why += " has no such bucket; make it, or name the right one (store.objects)";
  } else if (code == "RequestTimeTooSkewed") {
    why += " has another time; set this machine's clock";
  } else if (answer.status == 401 || answer.status == 403) {
    why += " refuses these keys (" + (code.empty() ? std::to_string(answer.status) : code) +
           "); give keys that may list the bucket, and read, write and delete in it";
  } else if (answer.status / 100 == 3 || code == "AuthorizationHeaderMalformed") {
    why +=
        " has the bucket in another region or at another address; see store.s3Region, "
        "store.s3Endpoint, store.s3Addressing";
  } else {
    why += " failed: " + std::to_string(answer.status);
    if (!code.empty()) why += " " + code;
    if (fault && !fault->message.empty()) why += " (" + fault->message.substr(0, 200) + ")";
  }
  return {ErrorCode::kIo, request.method + " " + request.key + ": " + why, "storage"};
}

}  // namespace farhorizon
