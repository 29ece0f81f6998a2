#pragma once

#include <string>

#include "cli/run/deployment.h"

namespace prospect::cli {

/// Services that one command starts for itself, on a bus of its own, and that end with it, however
/// it ends.
class OwnDeployment {
 public:
  /// @param bus that was asked for; empty: one that is nobody else's. @throws ExitError
  explicit OwnDeployment(const std::string& bus);
  OwnDeployment(const OwnDeployment&) = delete;
  OwnDeployment& operator=(const OwnDeployment&) = delete;
  ~OwnDeployment();

  const std::string& bus() const { return services_.bus(); }

  /// @param arguments of prospect-supervisor @throws ExitError, Ended
  void Start(Words arguments);

  /// Where `status` says that a service was lost and the supervisor gave one up: tells why, and
  /// gives that one's status. @return else `status`
  int Explained(int status) const;

  const Deployment& services() const { return services_; }

 private:
  std::string state_;
  Deployment services_;
};

}  // namespace prospect::cli
