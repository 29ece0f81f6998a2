#pragma once

#include <string>

namespace prospect::services {

/// The bus to use: `option` (--bus) if not empty, else the environment's LCM_DEFAULT_URL if not
/// empty, else cli::kDefaultBusUrl. A udpm URL that names no recv_buf_size gets the default's,
/// because LCM's own loses pictures.
std::string ResolveBusUrl(const std::string& option);

/// The largest UDP receive buffer this host grants (net.core.rmem_max, bytes), or 0 when it cannot
/// be read.
long ReceiveBufferLimit();

/// What to tell the user about a receive buffer that the host cuts short, with the command that
/// mends it; empty when all is well or the URL is not udpm.
std::string ReceiveBufferWarning(const std::string& url);

/// What to do when the bus at `url` cannot be opened: names the likely cause and the command that
/// mends it.
std::string BusAdvice(const std::string& url);

}  // namespace prospect::services
