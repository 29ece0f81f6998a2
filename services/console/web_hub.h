#pragma once

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <list>
#include <memory>
#include <set>
#include <string>

#include "services/console/page_files.h"
#include "services/console/request_guard.h"
#include "services/console/source.h"
#include "services/console/viewer.h"
#include "services/console/web_server.h"

namespace prospect::services::console {

class WebConnection;

/// What WebServer is inside: accepts connections, knows those that wait and those that are viewers.
/// I/O thread only, but for Notify().
class WebHub {
 public:
  WebHub(const WebOptions& options, const PageFiles& files, Source& source);
  ~WebHub();
  WebHub(const WebHub&) = delete;
  WebHub& operator=(const WebHub&) = delete;

  unsigned short port() const { return port_; }

  void Notify();
  void Run();

  // --- for connections
  const RequestGuard& guard() const { return guard_; }
  const PageFiles& files() const { return files_; }
  Source& source() { return source_; }
  void Forget(WebConnection* connection);
  /// False: there are too many viewers already.
  bool RoomForViewer() const { return viewers_.size() < WebServer::kMostViewers; }
  void Add(const std::shared_ptr<Viewer>& viewer);
  void Forget(Viewer* viewer);

 private:
  void Accept();
  void Tick();

  boost::asio::io_context io_{1};
  boost::asio::ip::tcp::acceptor acceptor_{io_};
  boost::asio::steady_timer tick_{io_};
  unsigned short port_;
  RequestGuard guard_;
  const PageFiles& files_;
  Source& source_;
  std::atomic<bool> notified_{false};
  std::list<std::shared_ptr<WebConnection>> waiting_;  // oldest first
  std::set<std::shared_ptr<Viewer>> viewers_;
};

}  // namespace prospect::services::console
