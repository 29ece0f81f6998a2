#pragma once

#include <string>
#include <vector>

namespace prospect::services {

/// A program of ours as a child of this one, from the folder that this one lies in, its output in a
/// file. It ends when this object or this process does. One thread.
class Child {
 public:
  /// @throws ExitError (kExitServiceLost) when there is no such program
  Child(const std::string& program, const std::vector<std::string>& arguments,
        const std::string& log);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  bool Running();
  /// Processor time used so far, seconds; what was last known once it has ended.
  double CpuSeconds();

 private:
  int pid_ = -1;
  double cpu_seconds_ = 0;
};

}  // namespace prospect::services
