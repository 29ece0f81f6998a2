#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace prospect::services {

/// Keeps a handler subscribed: it is called as long as this lives, and never again once this has
/// been destroyed or assigned to. So an object that holds the subscriptions of its own handlers is
/// never called after its end. It may be ended from inside any handler, its own among them (which
/// then runs to its end), and may outlive the bus. Belongs to the thread that polls the bus.
class [[nodiscard]] Subscription {
 public:
  /// Of nothing.
  Subscription() = default;
  Subscription(Subscription&&) = default;
  Subscription& operator=(Subscription&&) = default;

 private:
  template <class M>
  friend class HandlerList;
  explicit Subscription(std::shared_ptr<const void> handler) : handler_(std::move(handler)) {}

  std::shared_ptr<const void> handler_;
};

/// The handlers of messages M, each for as long as its Subscription lives, in order of
/// subscription. One thread.
template <class M>
class HandlerList {
 public:
  using Handler = std::function<void(const M&)>;

  Subscription Add(Handler handler) {
    std::erase_if(handlers_, [](const auto& old) { return old.expired(); });
    auto held = std::make_shared<const Handler>(std::move(handler));
    handlers_.push_back(held);
    return Subscription(std::move(held));
  }

  /// Nobody listens any more.
  bool empty() const {
    return std::all_of(handlers_.begin(), handlers_.end(),
                       [](const auto& handler) { return handler.expired(); });
  }

  void Call(const M& message) const {
    // Of a copy, and each held while it runs: a handler may subscribe and end subscriptions.
    const auto handlers = handlers_;
    for (const auto& handler : handlers) {
      if (const auto held = handler.lock()) (*held)(message);
    }
  }

 private:
  std::vector<std::weak_ptr<const Handler>> handlers_;
};

}  // namespace prospect::services
