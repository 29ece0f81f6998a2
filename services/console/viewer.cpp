#include "services/console/viewer.h"

#include <stdexcept>

#include "services/common/clock.h"
#include "services/console/page_values.h"

namespace prospect::services::console {
namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
using nlohmann::json;

constexpr std::size_t kMostPathsPerRequest = 64;
// A viewer that reads nothing for so long is let go; its page connects again by itself.
constexpr std::chrono::seconds kSilence(120);

}  // namespace

Viewer::Viewer(beast::tcp_stream stream, Source& source, std::function<void(Viewer*)> closed)
    : socket_(std::move(stream)),
      timer_(socket_.get_executor()),
      source_(source),
      closed_(std::move(closed)) {}

void Viewer::Start(const Request& request) {
  beast::get_lowest_layer(socket_).expires_never();
  socket_.set_option(websocket::stream_base::timeout{std::chrono::seconds(10), kSilence, true});
  socket_.read_message_max(kMostRequestBytes);
  socket_.auto_fragment(false);
  socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
    if (error) return self->End();
    self->open_ = true;
    self->Read();
    self->Pump(false);
  });
}

void Viewer::Read() {
  socket_.async_read(incoming_, [self = shared_from_this()](beast::error_code error, std::size_t) {
    self->OnRead(error);
  });
}

void Viewer::OnRead(beast::error_code error) {
  if (error) return End();
  const std::int64_t second = SteadyMs() / 1000;
  if (second != second_) second_ = second, requests_ = 0;
  if (++requests_ > kMostRequestsPerSecond || !socket_.got_text()) return Close();
  const std::string text = beast::buffers_to_string(incoming_.data());
  incoming_.consume(incoming_.size());
  Take(text);
  if (!ended_) Read();
}

void Viewer::Take(const std::string& text) {
  const json request = json::parse(text, nullptr, false);
  if (!request.is_object() || !request.contains("t") || !request["t"].is_string()) return Close();
  try {
    Obey(request);
  } catch (const std::exception& error) {
    Control({{"t", "wrong"}, {"words", error.what()}});
  }
  Pump(false);
}

void Viewer::Obey(const json& request) {
  const std::string what = request["t"];
  if (what == "watch")
    return feed_.Watch(request.at("search").is_null() ? 0 : IdFrom(request["search"]));
  if (what == "want") return Want(request);
  if (what == "choices") return TellChoices(request);
  const std::string wrong = source_.Do(what, request);
  if (!wrong.empty()) Control({{"t", "wrong"}, {"of", what}, {"words", wrong}});
}

void Viewer::Want(const json& request) {
  const std::int64_t search = IdFrom(request.at("search"));
  const json& paths = request.at("paths");
  if (!paths.is_array() || paths.size() > kMostPathsPerRequest)
    throw std::invalid_argument("too many paths");
  for (const json& value : paths) {
    const planner::Path path = PathFrom(value);
    feed_.Want(search, path);
    source_.WantPicture(search, path, request.value("urgent", false));
  }
}

void Viewer::TellChoices(const json& request) {
  const std::int64_t id = IdFrom(request.at("search"));
  const int node = request.at("node").get<int>();
  json choices;
  {
    const std::lock_guard<std::mutex> lock(source_.mutex());
    const SearchView* search = source_.model().Find(id);
    if (search) choices = search->Choices(node);
  }
  Control({{"t", "choices"}, {"search", std::to_string(id)}, {"node", node}, {"choices", choices}});
}

void Viewer::Control(const json& message) {
  if (control_.size() >= kMostControl) return Close();
  control_.push_back(Dump(message));
}

void Viewer::Pump(bool news) {
  if (!open_ || ended_) return;
  if (news) {
    const std::lock_guard<std::mutex> lock(source_.mutex());
    feed_.NoteNews(source_.model());
  }
  if (writing_) return;
  std::string facts = Dump(source_.Facts());
  if (facts != facts_) {
    facts_ = std::move(facts);
    control_.push_front(R"({"t":"facts","facts":)" + facts_ + "}");
  }
  if (!control_.empty()) {
    Frame frame{false, std::move(control_.front())};
    control_.pop_front();
    return Write(std::move(frame));
  }
  std::optional<Frame> frame;
  {
    const std::lock_guard<std::mutex> lock(source_.mutex());
    frame = feed_.Next(source_.model(), SteadyMs());
  }
  if (frame) return Write(std::move(*frame));
  Wait();
}

void Viewer::Write(Frame frame) {
  writing_ = true;
  outgoing_ = std::move(frame);
  socket_.binary(outgoing_.binary);
  socket_.async_write(boost::asio::buffer(outgoing_.data),
                      [self = shared_from_this()](beast::error_code error, std::size_t) {
                        self->writing_ = false;
                        if (error) return self->End();
                        self->Pump(false);
                      });
}

// Until what is held back now may go; an earlier wait ends, which may have been for longer.
void Viewer::Wait() {
  timer_.expires_after(std::chrono::milliseconds(feed_.DueMs(SteadyMs())));
  timer_.async_wait([self = shared_from_this()](beast::error_code error) {
    if (!error) self->Pump(false);
  });
}

void Viewer::Close() {
  if (ended_) return;
  beast::error_code ignored;
  beast::get_lowest_layer(socket_).socket().shutdown(boost::asio::socket_base::shutdown_both,
                                                     ignored);
  End();
}

void Viewer::End() {
  if (ended_) return;
  ended_ = true;
  open_ = false;
  timer_.cancel();
  beast::get_lowest_layer(socket_).close();
  if (closed_) closed_(this);
}

}  // namespace prospect::services::console
