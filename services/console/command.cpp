#include "services/console/command.h"

#include <spdlog/spdlog.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include "base/atomic_file.h"
#include "base/child_process.h"
#include "base/exit_error.h"
#include "base/hash.h"
#include "cli/installation.h"
#include "services/common/authenticity.h"
#include "services/common/common_options.h"
#include "services/common/signals.h"
#include "services/console/bus_source.h"
#include "services/console/log_source.h"
#include "services/console/request_guard.h"
#include "services/console/web_server.h"

namespace prospect::services {
namespace {

using namespace console;

constexpr unsigned short kUsualPort = 7660;

bool IsLoopback(const std::string& address) {
  return address.starts_with("127.") || address == "::1";
}

// From the deployment's key, so that it stays the same when this program is started again and a
// page that is open finds it: who knows one may command the robot, and so may who knows the other.
std::string TokenOfKey(const BusKey& key) {
  std::uint8_t mac[KeyedMac::kBytes];
  const std::string what = "the console's token";
  KeyedMac(key).Compute("CONSOLE", reinterpret_cast<const std::uint8_t*>(what.data()), what.size(),
                        mac);
  std::string token;
  char digits[3];
  for (const std::uint8_t byte : mac) {
    std::snprintf(digits, sizeof digits, "%02x", byte);
    token += digits;
  }
  return token;
}

// On the loopback of a machine others may have accounts, too: who has no key shall press no button
// there. Looking is free, as it is on the bus.
std::string TokenFor(const cli::ConsoleOptions& options, const std::string& address) {
  const BusKey* key = ProcessBusKey();
  if (IsLoopback(address) && (!options.control || !key)) return "";
  return key ? TokenOfKey(*key) : MakeToken();
}

std::string UrlOf(const std::string& address, unsigned short port, const std::string& token) {
  const bool six = address.find(':') != std::string::npos;
  std::string url =
      "http://" + (six ? "[" + address + "]" : address) + ":" + std::to_string(port) + "/";
  return token.empty() ? url : url + "#token=" + token;
}

// A token on a command line is there for everybody to read; in a file of this user's alone it is
// not.
std::string FileThatLeadsTo(const std::string& url) {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  std::string path = std::string(runtime ? runtime : "/tmp") + "/prospect-console-XXXXXX.html";
  const base::Descriptor file(mkstemps(path.data(), 5));
  if (!file) return "";
  const std::string text = "<!doctype html><meta http-equiv=refresh content=\"0;url=" + url +
                           "\"><a href=\"" + url + "\">the console</a>\n";
  const ssize_t written = write(file.get(), text.data(), text.size());
  return written == static_cast<ssize_t>(text.size()) ? path : "";
}

std::optional<base::ChildProcess> OpenBrowser(const std::string& url) {
  const bool display = std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY");
  if (!display) return std::nullopt;
  const std::string place = FileThatLeadsTo(url);
  base::ChildOptions options;
  options.command = {"/usr/bin/xdg-open", place};
  options.detached = true;
  if (place.empty() || access("/usr/bin/xdg-open", X_OK) != 0) return std::nullopt;
  return base::ChildProcess(options);
}

std::unique_ptr<Source> SourceFor(const cli::ConsoleOptions& options,
                                  std::function<void()> notify) {
  const auto bytes = static_cast<std::size_t>(options.memory_mb) << 20;
  if (!options.log.empty())
    return std::make_unique<LogSource>(options.log, bytes, std::move(notify));
  BusSourceOptions bus;
  bus.bus = options.bus.bus;
  bus.services_file = options.services_file;
  bus.out = options.out;
  bus.control = options.control;
  bus.memory_bytes = bytes;
  return std::make_unique<BusSource>(bus, std::move(notify));
}

// The usual port, so that a page finds a console that was started again; another one if somebody
// else has it.
std::unique_ptr<WebServer> ServerFor(const cli::ConsoleOptions& options, WebOptions web,
                                     const PageFiles& files, Source& source) {
  web.port = static_cast<unsigned short>(options.port.value_or(kUsualPort));
  if (options.port) return std::make_unique<WebServer>(web, files, source);
  try {
    return std::make_unique<WebServer>(web, files, source);
  } catch (const ExitError&) {
    web.port = 0;
    return std::make_unique<WebServer>(web, files, source);
  }
}

void Tell(const cli::ConsoleOptions& options, const std::string& url) {
  std::printf("The console: %s\n", url.c_str());
  std::fflush(stdout);
  if (options.url_file.empty()) return;
  const mode_t mask = umask(077);  // it may hold a token
  base::WriteFile(options.url_file, url + "\n");
  umask(mask);
}

}  // namespace

int RunConsole(const cli::ConsoleOptions& options) {
  ApplyCommonOptions(CommonOptions(options.bus), "console");
  const PageFiles files(cli::DataFolder("services/console/page"), PROSPECT_D3);
  std::atomic<WebServer*> running{nullptr};
  const auto source = SourceFor(options, [&running] {
    if (WebServer* server = running) server->Notify();
  });
  WebOptions web;
  if (!options.listen.empty()) web.address = options.listen;
  web.token = TokenFor(options, web.address);
  const auto server = ServerFor(options, web, files, *source);
  running = server.get();
  const std::string url = UrlOf(web.address, server->port(), web.token);
  Tell(options, url);
  const auto browser = options.browser ? OpenBrowser(url) : std::nullopt;
  server->Run();
  running = nullptr;
  return kExitSuccess;
}

}  // namespace prospect::services
