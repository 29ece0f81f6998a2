#pragma once

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <memory>
#include <optional>

#include "services/console/viewer.h"

namespace prospect::services::console {

class WebHub;

/// One TCP connection until it asks to become a viewer: answers GET from the page's files, one
/// request after the other, and refuses everything else. I/O thread only.
class WebConnection : public std::enable_shared_from_this<WebConnection> {
 public:
  WebConnection(boost::asio::ip::tcp::socket socket, WebHub& server);

  void Read();
  /// Ends it, whatever it does.
  void Close();

 private:
  using Response = boost::beast::http::response<boost::beast::http::string_body>;
  using Status = boost::beast::http::status;

  void OnRead(boost::beast::error_code error);
  void Upgrade();
  Response Answer() const;
  Response Refusal(Status status, const std::string& words) const;
  /// Empty: it may be answered.
  std::string Defect(bool upgrade) const;
  void Write(Response response);

  boost::beast::tcp_stream stream_;
  WebHub& server_;
  boost::beast::flat_buffer buffer_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> parser_;
  Response response_;
};

}  // namespace prospect::services::console
