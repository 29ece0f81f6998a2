#pragma once

#include <memory>
#include <string>

#include "services/console/page_files.h"
#include "services/console/source.h"

namespace prospect::services::console {

class WebHub;

struct WebOptions {
  std::string address = "127.0.0.1";
  unsigned short port = 0;  ///< 0: one that is free
  std::string token;        ///< empty: none is asked for
};

/// Serves the page and its WebSocket. Bounded in every direction: at most kMostWaiting connections
/// that have not become a viewer (one more, and the oldest of them is closed), kMostViewers
/// viewers, 8 kB of headers, no bodies, 10 s for a request and 30 s for taking an answer. Whoever
/// runs Run() is the I/O thread. This header knows no Boost.
class WebServer {
 public:
  static constexpr std::size_t kMostWaiting = 64, kMostViewers = 32;

  /// Listens from here on. Files and source must outlive it.
  /// @throws ExitError (kExitUsage) when the address cannot be had
  WebServer(const WebOptions& options, const PageFiles& files, Source& source);
  ~WebServer();

  unsigned short port() const;

  /// The model has something new. From any thread; cheap when called often.
  void Notify();
  /// Serves until a stop signal comes.
  void Run();

 private:
  std::unique_ptr<WebHub> hub_;
};

}  // namespace prospect::services::console
