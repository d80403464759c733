#pragma once

#include <memory>
#include <string>

// PROJ's own names of PJ_CONTEXT and PJ: headers do without those of PROJ.
struct pj_ctx;
struct PJconsts;

namespace farhorizon {

/// Frees what PROJ has made.
struct ProjDelete {
  void operator()(pj_ctx* context) const;
  void operator()(PJconsts* object) const;
};
/// A PJ: a reference system, a datum, or an operation between two systems.
using ProjObject = std::unique_ptr<PJconsts, ProjDelete>;

/// A context of PROJ that opens its packaged files alone (SealContext), fetches nothing and
/// prints nothing: its last message is kept for errors.
/// Objects made with a session do not outlive it.
/// Threads: one at a time.
class ProjSession {
 public:
  ProjSession();
  ProjSession(const ProjSession&) = delete;
  ProjSession& operator=(const ProjSession&) = delete;

  [[nodiscard]] pj_ctx* get() const { return context_.get(); }
  /// " (PROJ: ...)", or "" where PROJ has not complained.
  [[nodiscard]] std::string Complaint() const;

 private:
  std::string complaint_;
  std::unique_ptr<pj_ctx, ProjDelete> context_;
};

}  // namespace farhorizon
