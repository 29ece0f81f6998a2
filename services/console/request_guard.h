#pragma once

#include <string>
#include <string_view>

namespace prospect::services::console {

/// Who is let in by what a browser says. A page of another site may make a browser ask this server
/// (and by a name that resolves to 127.0.0.1 even read the answers), so the Host must be an address
/// or this machine's name, and an Origin must be this server's. A token, if there is one, must be
/// known to whoever looks. Pure; safe from any thread.
class RequestGuard {
 public:
  /// @param port that the server listens on @param token empty: none is asked for
  RequestGuard(unsigned short port, std::string token);

  /// "127.0.0.1:8080", "localhost:8080", "[::1]:8080", an address or the machine's name, with our
  /// port.
  bool HostAllowed(std::string_view host) const;
  /// Exactly "http://" and this very Host. @param needed false: none at all will do, too
  bool OriginAllowed(std::string_view origin, std::string_view host, bool needed) const;
  /// Compared in a time that tells nothing.
  bool TokenRight(std::string_view token) const;

 private:
  std::string port_, token_, machine_;
};

/// The value of `name` in "?a=b&c=d", as it is; empty: not there.
std::string_view QueryValue(std::string_view target, std::string_view name);

/// 32 random hexadecimal digits. @throws std::runtime_error
std::string MakeToken();

}  // namespace prospect::services::console
