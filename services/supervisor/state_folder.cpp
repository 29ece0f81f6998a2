#include "services/supervisor/state_folder.h"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>

#include <array>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "base/exit_error.h"
#include "services/common/bus_url.h"

namespace prospect::services {
namespace {

constexpr mode_t kOthersMayWrite = S_IWGRP | S_IWOTH;
// No name that other programs lock in folders of theirs: who holds it is signalled.
constexpr char kLockName[] = "prospect-supervisor.lock";
constexpr const char* kLeftBehind[] = {"console.url", "services.json", "key"};

[[noreturn]] void Distrust(const std::string& path, const std::string& reason) {
  throw ExitError(kExitDisk, "the state folder cannot be " + path + ": " + reason +
                                 "; remove it, or set XDG_RUNTIME_DIR to a folder of your own");
}

bool IsOurs(const std::string& folder) {
  struct stat found {};
  return !folder.empty() && stat(folder.c_str(), &found) == 0 && S_ISDIR(found.st_mode) &&
         found.st_uid == geteuid();
}

std::string RuntimeFolder() {
  const std::string user = std::to_string(geteuid());
  const char* set = std::getenv("XDG_RUNTIME_DIR");
  for (const std::string& folder : {std::string(set ? set : ""), "/run/user/" + user}) {
    if (IsOurs(folder)) return folder + "/prospect";
  }
  // Root of a user namespace may not write to /run.
  const bool root = geteuid() == 0 && access("/run", W_OK) == 0;
  return (root ? "/run/prospect-" : "/tmp/prospect-") + user;
}

// A path that may lie about what is there is no path of ours; nothing: there is none.
base::Descriptor OpenFolder(const std::string& path) {
  base::Descriptor folder(open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  if (folder || errno == ENOENT) return folder;
  if (errno == ENOTDIR || errno == ELOOP) Distrust(path, "it is a link or no folder");
  Distrust(path, std::strerror(errno));
}

struct stat StatOf(const base::Descriptor& file, const std::string& path) {
  struct stat found {};
  if (fstat(file.get(), &found) != 0) Distrust(path, std::strerror(errno));
  return found;
}

// In a folder like this nobody but its owner and root can put something in another's place.
void RequireSafeParent(const base::Descriptor& folder, const std::string& path) {
  const struct stat found = StatOf(folder, path);
  if (found.st_uid != geteuid() && found.st_uid != 0) {
    Distrust(path, "it belongs to user " + std::to_string(found.st_uid));
  }
  const bool sticky = found.st_uid == 0 && (found.st_mode & S_ISVTX) != 0;
  if ((found.st_mode & kOthersMayWrite) != 0 && !sticky) Distrust(path, "others may write to it");
}

void RequireOwn(const base::Descriptor& folder, const std::string& path,
                StateFolder::IfAbsent how) {
  const struct stat found = StatOf(folder, path);
  if (found.st_uid != geteuid()) {
    Distrust(path, "it belongs to user " + std::to_string(found.st_uid));
  }
  if ((found.st_mode & kOthersMayWrite) != 0) Distrust(path, "others may write to it");
  // Nor need they read the key; but who only asks changes nothing.
  if (how == StateFolder::IfAbsent::kMake) fchmod(folder.get(), S_IRWXU);
}

void Make(const std::string& path) {
  if (mkdir(path.c_str(), S_IRWXU) != 0 && errno != EEXIST) {
    throw ExitError(kExitDisk, "cannot make " + path + ": " + std::strerror(errno));
  }
}

std::string Absolute(const std::string& path) {
  std::string absolute = std::filesystem::absolute(path).lexically_normal().string();
  while (absolute.size() > 1 && absolute.back() == '/') absolute.pop_back();
  return absolute;
}

struct flock WholeFile() {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  return lock;
}

std::string RandomHex() {
  std::array<unsigned char, 32> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw std::runtime_error("the system gives no random numbers (getrandom failed)");
  }
  std::string text;
  for (const unsigned char byte : bytes) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

}  // namespace

std::string StateFolderOf(const std::string& bus) {
  std::string name = ResolveBusUrl(bus);
  // What stands behind the address of a multicast bus (ttl, buffers) makes no other bus of it.
  if (name.starts_with("udpm://")) name = name.substr(0, name.find('?')).substr(7);
  for (char& letter : name) {
    const auto code = static_cast<unsigned char>(letter);
    if (std::isalnum(code) == 0 && letter != '.') letter = '_';
  }
  return RuntimeFolder() + "/" + name.substr(0, 200);
}

std::string MakePrivateFolder() {
  const std::string base = RuntimeFolder();
  // Trusted before anything is made in it.
  Make(base);
  RequireOwn(OpenFolder(base), base, StateFolder::IfAbsent::kMake);
  std::string path = base + "/private-XXXXXX";
  if (mkdtemp(path.data()) == nullptr) {
    throw ExitError(kExitDisk, "cannot make a folder in " + base + ": " + std::strerror(errno));
  }
  return path;
}

StateFolder::StateFolder(const std::string& path, IfAbsent if_absent) : path_(Absolute(path)) {
  const std::string above = std::filesystem::path(path_).parent_path().string();
  if (if_absent == IfAbsent::kMake) Make(above);
  const base::Descriptor parent = OpenFolder(above);
  if (!parent) return;
  RequireSafeParent(parent, above);
  if (if_absent == IfAbsent::kMake) Make(path_);
  folder_ = OpenFolder(path_);
  if (folder_) RequireOwn(folder_, path_, if_absent);
}

StateFolder::~StateFolder() {
  if (lock_) Clear();
}

bool StateFolder::Lock() {
  constexpr int kHow = O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC;
  base::Descriptor file(openat(folder_.get(), kLockName, kHow, S_IRUSR | S_IWUSR));
  if (!file) throw ExitError(kExitDisk, path_ + "/" + kLockName + ": " + std::strerror(errno));
  struct flock lock = WholeFile();
  if (fcntl(file.get(), F_SETLK, &lock) != 0) {
    if (errno == EACCES || errno == EAGAIN) return false;
    throw ExitError(kExitDisk,
                    path_ + "/" + kLockName + " cannot be locked: " + std::strerror(errno));
  }
  lock_ = std::move(file);
  return true;
}

bool StateFolder::was_used() const {
  struct stat found {};
  return folder_ && fstatat(folder_.get(), kLockName, &found, AT_SYMLINK_NOFOLLOW) == 0;
}

int StateFolder::Holder() const {
  // Closing any descriptor of the file would give the lock up.
  if (lock_) return getpid();
  if (!folder_) return kNobody;
  const base::Descriptor file(openat(folder_.get(), kLockName, O_RDONLY | O_NOFOLLOW | O_CLOEXEC));
  struct flock lock = WholeFile();
  if (!file || fcntl(file.get(), F_GETLK, &lock) != 0 || lock.l_type == F_UNLCK) return kNobody;
  return lock.l_pid > 0 ? lock.l_pid : kUnseen;
}

std::string StateFolder::MakeKey() const {
  constexpr int kHow = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  unlinkat(folder_.get(), "key", 0);
  const base::Descriptor file(openat(folder_.get(), "key", kHow, S_IRUSR | S_IWUSR));
  const std::string line = RandomHex() + "\n";
  if (!file || write(file.get(), line.data(), line.size()) != static_cast<ssize_t>(line.size())) {
    throw ExitError(kExitDisk, path_ + "/key cannot be written: " + std::strerror(errno));
  }
  return path_ + "/key";
}

bool StateFolder::Clear() const {
  bool something = false;
  for (const char* name : kLeftBehind) {
    if (unlinkat(folder_.get(), name, 0) == 0) something = true;
  }
  return something;
}

void StateFolder::Remove() {
  Clear();
  unlinkat(folder_.get(), kLockName, 0);
  rmdir(path_.c_str());
}

}  // namespace prospect::services
