#pragma once

#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <functional>
#include <memory>
#include <string>

#include "services/console/source.h"
#include "services/console/viewer_feed.h"

namespace prospect::services::console {

/// A page that is open: one WebSocket. Answers and facts (control) wait in a short queue and go
/// first; data is made when it can be sent (viewer_feed.h). What a page sends is bounded in size
/// and rate; one that breaks the bounds is closed. I/O thread only.
class Viewer : public std::enable_shared_from_this<Viewer> {
 public:
  using Request = boost::beast::http::request<boost::beast::http::empty_body>;

  static constexpr std::size_t kMostRequestBytes = 16 << 10;
  static constexpr int kMostRequestsPerSecond = 200;
  static constexpr std::size_t kMostControl = 64;

  /// @param closed called once, when the viewer is gone
  Viewer(boost::beast::tcp_stream stream, Source& source, std::function<void(Viewer*)> closed);

  /// Takes the upgrade over.
  void Start(const Request& request);
  /// Something was heard, or time has passed: sends what there is, unless it sends already.
  void Pump(bool news);
  void Close();

 private:
  void Read();
  void OnRead(boost::beast::error_code error);
  void Take(const std::string& text);
  void Obey(const nlohmann::json& request);
  void Want(const nlohmann::json& request);
  void TellChoices(const nlohmann::json& request);
  void Control(const nlohmann::json& message);
  void Write(Frame frame);
  void Wait();
  void End();

  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
  boost::asio::steady_timer timer_;
  Source& source_;
  std::function<void(Viewer*)> closed_;
  boost::beast::flat_buffer incoming_;
  ViewerFeed feed_;
  std::deque<std::string> control_;
  Frame outgoing_;
  std::string facts_;
  bool open_ = false, writing_ = false, ended_ = false;
  std::int64_t second_ = 0;
  int requests_ = 0;
};

}  // namespace prospect::services::console
