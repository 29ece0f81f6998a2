#pragma once

#include <cstdint>

namespace prospect::services {

/// A random id, 1 .. 2^63 - 1, from the operating system: for instance, client, writer, executive
/// and search ids. Two processes started in the same microsecond, or forked from one parent, still
/// differ. Thread-safe.
/// @throws std::runtime_error when the system has no random source.
std::int64_t RandomId();

/// The id of this deployment: what PROSPECT_DEPLOYMENT holds (a decimal number, 1 .. 2^63 - 1), or
/// 0 when it is unset or empty. All processes of one launch share it; 0 joins whatever is on the
/// bus.
/// @throws std::runtime_error when the variable holds anything else.
std::int64_t DeploymentId();

/// Sets what DeploymentId() returns from now on (option --deployment). @param id at least 0.
void SetDeploymentId(std::int64_t id);

}  // namespace prospect::services
