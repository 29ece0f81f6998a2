#include "services/console/web_hub.h"

#include <boost/asio/post.hpp>

#include "base/exit_error.h"
#include "services/common/signals.h"
#include "services/console/web_connection.h"

namespace prospect::services::console {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

constexpr std::chrono::milliseconds kTick(50), kAcceptAgain(100);

// What the kernel may hold for a viewer that stalls: more would only be old when it reads on.
constexpr int kSendBytes = 128 << 10;

// Binds and listens. @return the port that it is
unsigned short Listen(tcp::acceptor* acceptor, const WebOptions& options) try {
  const tcp::endpoint place(asio::ip::make_address(options.address), options.port);
  acceptor->open(place.protocol());
  acceptor->set_option(tcp::acceptor::reuse_address(true));
  acceptor->bind(place);
  acceptor->listen();
  return acceptor->local_endpoint().port();
} catch (const boost::system::system_error& error) {
  throw ExitError(kExitUsage, "cannot serve on " + options.address + " port " +
                                  std::to_string(options.port) + ": " + error.code().message());
}

}  // namespace

WebHub::WebHub(const WebOptions& options, const PageFiles& files, Source& source)
    : port_(Listen(&acceptor_, options)),
      guard_(port_, options.token),
      files_(files),
      source_(source) {}

WebHub::~WebHub() = default;

void WebHub::Accept() {
  acceptor_.async_accept([this](boost::system::error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (error) {  // no descriptors left, most likely: a little later there may be
      auto timer = std::make_shared<asio::steady_timer>(io_, kAcceptAgain);
      return timer->async_wait([this, timer](boost::system::error_code) { Accept(); });
    }
    boost::system::error_code ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    socket.set_option(tcp::socket::send_buffer_size(kSendBytes), ignored);
    if (waiting_.size() >= WebServer::kMostWaiting) {
      const auto oldest = waiting_.front();
      waiting_.pop_front();
      oldest->Close();
    }
    waiting_.push_back(std::make_shared<WebConnection>(std::move(socket), *this));
    waiting_.back()->Read();
    Accept();
  });
}

void WebHub::Forget(WebConnection* connection) {
  waiting_.remove_if([&](const auto& waiting) { return waiting.get() == connection; });
}

void WebHub::Add(const std::shared_ptr<Viewer>& viewer) { viewers_.insert(viewer); }

void WebHub::Forget(Viewer* viewer) {
  std::erase_if(viewers_, [&](const auto& one) { return one.get() == viewer; });
}

// Calls of many messages become one.
void WebHub::Notify() {
  if (notified_.exchange(true)) return;
  asio::post(io_, [this] {
    notified_ = false;
    const auto viewers = viewers_;  // one may leave meanwhile
    for (const auto& viewer : viewers) viewer->Pump(/*news=*/true);
  });
}

void WebHub::Tick() {
  if (StopRequested()) return io_.stop();
  source_.Tick();
  tick_.expires_after(kTick);
  tick_.async_wait([this](boost::system::error_code error) {
    if (!error) Tick();
  });
}

void WebHub::Run() {
  Accept();
  Tick();
  io_.run();
}

}  // namespace prospect::services::console
