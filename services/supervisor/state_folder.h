#pragma once

#include <string>

#include "base/descriptor.h"

namespace prospect::services {

/// Where the deployment on `bus` (as --bus takes it) keeps its state: a folder named after the
/// bus's address in `prospect` below $XDG_RUNTIME_DIR or /run/user/UID where that is this user's,
/// else in /run/prospect-UID (root) or /tmp/prospect-UID.
std::string StateFolderOf(const std::string& bus);

/// Makes a new folder beside those, for a deployment that nobody else needs to find.
/// @throws ExitError (kExitDisk)
std::string MakePrivateFolder();

/// The folder in which a deployment keeps what later shells ask for: services.json, key, logs/.
///
/// Whoever could plant something in it could have strangers' files overwritten and strangers'
/// processes ended. So it and the folder above it are opened without following links, and taken
/// only when they are this user's (the one above: or root's) and nobody else may write to them.
///
/// A deployment lives as long as its supervisor holds the record lock on the file `lock` in it. The
/// lock dies with its holder, is not inherited by children, and the kernel knows who holds it:
/// unlike a number in a file it never names a stranger's process. One thread.
class StateFolder {
 public:
  enum class IfAbsent { kMake, kAccept };

  /// @throws ExitError (kExitDisk), one line with the reason, when it cannot be trusted or made
  StateFolder(const std::string& path, IfAbsent if_absent);

  /// Gives the lock up, if it has it, and clears the folder before.
  ~StateFolder();
  StateFolder(StateFolder&&) = default;

  /// Absolute.
  const std::string& path() const { return path_; }
  bool exists() const { return static_cast<bool>(folder_); }

  /// Whether a supervisor has ever locked it: what lies in another folder is not ours to remove.
  bool was_used() const;

  /// Takes the lock until this object goes. @return false when another process holds it
  /// @throws ExitError (kExitDisk) when there can be no lock
  bool Lock();

  static constexpr int kNobody = 0;
  static constexpr int kUnseen = -1;  ///< a process of another process id namespace
  /// The process that holds the lock, kNobody or kUnseen.
  int Holder() const;

  /// Makes the file `key`, mode 0600: 64 hexadecimal digits of the system's randomness on a line.
  /// @return its path @throws ExitError (kExitDisk)
  std::string MakeKey() const;

  /// Removes what a deployment left, but for its logs. Only for who has the lock.
  /// @return whether there was something
  bool Clear() const;

  /// Removes the folder itself, where nothing else is left in it.
  void Remove();

 private:
  std::string path_;
  base::Descriptor folder_, lock_;
};

}  // namespace prospect::services
