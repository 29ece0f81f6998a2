#include "services/console/web_connection.h"

#include "services/console/web_hub.h"

namespace prospect::services::console {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;

constexpr std::size_t kMostHeaderBytes = 8 << 10;
constexpr std::chrono::seconds kRequestTime(10), kAnswerTime(30);

// Scripts and styles of this server alone, no inline ones, nobody's frame: what comes from the bus
// could not run even if it became markup somewhere.
constexpr char kPolicy[] =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string_view View(beast::string_view text) { return {text.data(), text.size()}; }

}  // namespace

WebConnection::WebConnection(boost::asio::ip::tcp::socket socket, WebHub& server)
    : stream_(std::move(socket)), server_(server), buffer_(kMostHeaderBytes + 1024) {}

void WebConnection::Close() {
  beast::error_code ignored;
  stream_.socket().shutdown(boost::asio::socket_base::shutdown_both, ignored);
  stream_.close();
}

void WebConnection::Read() {
  parser_.emplace();
  parser_->header_limit(kMostHeaderBytes);
  parser_->body_limit(0);
  stream_.expires_after(kRequestTime);
  http::async_read(
      stream_, buffer_, *parser_,
      [self = shared_from_this()](beast::error_code error, std::size_t) { self->OnRead(error); });
}

void WebConnection::OnRead(beast::error_code error) {
  if (error == http::error::header_limit || error == http::error::body_limit ||
      error == http::error::buffer_overflow) {
    return Write(Refusal(Status::request_header_fields_too_large, "the request is too long"));
  }
  if (error == http::error::end_of_stream || !parser_ || (error && !parser_->got_some()))
    return server_.Forget(this);
  if (error) return Write(Refusal(Status::bad_request, "this is no request"));
  if (beast::websocket::is_upgrade(parser_->get())) return Upgrade();
  Write(Answer());
}

std::string WebConnection::Defect(bool upgrade) const {
  const auto& request = parser_->get();
  const std::string_view host = View(request[http::field::host]);
  if (!server_.guard().HostAllowed(host)) return "this server has another name";
  if (!server_.guard().OriginAllowed(View(request[http::field::origin]), host, upgrade))
    return "asked by a page of another site";
  return "";
}

void WebConnection::Upgrade() {
  const std::string defect = Defect(/*upgrade=*/true);
  if (!defect.empty()) return Write(Refusal(Status::forbidden, defect));
  const std::string_view target = View(parser_->get().target());
  if (!target.starts_with("/live"))
    return Write(Refusal(Status::not_found, "there is no such thing here"));
  if (!server_.guard().TokenRight(QueryValue(target, "token")))
    return Write(
        Refusal(Status::forbidden,
                "the token is missing or wrong: use the address that the console printed"));
  if (!server_.RoomForViewer())
    return Write(Refusal(Status::service_unavailable, "too many pages are open"));
  const auto self = shared_from_this();  // forgotten below, and still at work
  const auto viewer =
      std::make_shared<Viewer>(std::move(stream_), server_.source(),
                               [&server = server_](Viewer* gone) { server.Forget(gone); });
  server_.Add(viewer);
  viewer->Start(parser_->get());
  server_.Forget(this);
}

WebConnection::Response WebConnection::Refusal(Status status, const std::string& words) const {
  Response response{status, 11};
  response.set(http::field::content_type, "text/plain; charset=utf-8");
  response.body() = words + "\n";
  response.keep_alive(false);
  return response;
}

WebConnection::Response WebConnection::Answer() const {
  const auto& request = parser_->get();
  const std::string defect = Defect(/*upgrade=*/false);
  if (!defect.empty()) return Refusal(Status::forbidden, defect);
  if (request.method() != http::verb::get && request.method() != http::verb::head)
    return Refusal(Status::method_not_allowed, "only GET is answered");
  const std::string target(request.target());
  const PageFiles::File* file = server_.files().Find(target.substr(0, target.find('?')));
  if (!file) return Refusal(Status::not_found, "there is no such thing here");
  Response response{Status::ok, 11};
  response.set(http::field::content_type, file->type);
  response.keep_alive(request.keep_alive());
  if (request.method() == http::verb::get) response.body() = file->text;
  return response;
}

void WebConnection::Write(Response response) {
  response_ = std::move(response);
  response_.set("Content-Security-Policy", kPolicy);
  response_.set("X-Content-Type-Options", "nosniff");
  response_.set("Referrer-Policy", "no-referrer");
  response_.set("Cross-Origin-Resource-Policy", "same-origin");
  response_.set(http::field::cache_control, "no-store");
  response_.prepare_payload();
  stream_.expires_after(kAnswerTime);
  http::async_write(stream_, response_,
                    [self = shared_from_this()](beast::error_code error, std::size_t) {
                      if (error || !self->response_.keep_alive()) {
                        self->Close();
                        return self->server_.Forget(self.get());
                      }
                      self->Read();
                    });
}

}  // namespace prospect::services::console
