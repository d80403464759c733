#include "core/horizon/kinetic/hulls/certificate_queue.h"

#include "core/base/result.h"

namespace farhorizon::kinetic {

void CertificateQueue::Schedule(CertificateKind kind, std::int32_t id,
                                const std::optional<SweepDepth>& at) {
  Certificate& certificate = At(kind, id);
  Cancel(certificate);
  if (!at) return;
  certificate.pending = true;
  ++pending_;
  events_.push({*at, kind, certificate.stamp, id});
}

void CertificateQueue::Cancel(CertificateKind kind, std::int32_t id) { Cancel(At(kind, id)); }

std::optional<SweepDepth> CertificateQueue::NextDepth() {
  while (!events_.empty()) {
    const Event& next = events_.top();
    if (At(next.kind, next.id).stamp == next.stamp) return next.at;
    events_.pop();
  }
  return std::nullopt;
}

std::optional<Event> CertificateQueue::PopAt(const SweepDepth& now) {
  const std::optional<SweepDepth> next = NextDepth();
  if (!next) return std::nullopt;
  const int order = Compare(*next, now);
  Check(order >= 0, "no certificate has failed unnoticed");
  if (order > 0) return std::nullopt;
  const Event event = events_.top();
  events_.pop();
  Cancel(event.kind, event.id);
  return event;
}

bool CertificateQueue::WasUsed(CertificateKind kind, std::int32_t id) const {
  const std::vector<Certificate>& of_kind = certificates_[static_cast<std::size_t>(kind)];
  const auto i = static_cast<std::size_t>(id);
  return i < of_kind.size() && of_kind[i].stamp != 0;
}

CertificateQueue::Certificate& CertificateQueue::At(CertificateKind kind, std::int32_t id) {
  std::vector<Certificate>& of_kind = certificates_[static_cast<std::size_t>(kind)];
  const auto i = static_cast<std::size_t>(id);
  if (i >= of_kind.size()) of_kind.resize(i + 1);
  return of_kind[i];
}

void CertificateQueue::Cancel(Certificate& certificate) {
  if (certificate.pending) --pending_;
  certificate.pending = false;
  ++certificate.stamp;
}

}  // namespace farhorizon::kinetic
