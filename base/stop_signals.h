#pragma once

namespace prospect::base {

/// From now on SIGINT and SIGTERM raise a flag instead of ending the process, so that an event loop
/// can stop safely: cancel what moves, say so on HEALTH, close files. The handlers are installed
/// without SA_RESTART: Bus::Poll returns at once. SIGPIPE is ignored. A second signal while the
/// first is being honoured ends the process the usual way.
void InstallStopSignals();

/// True once SIGINT or SIGTERM came, or RequestStop() was called. Safe from any thread.
bool StopRequested();

/// Raises the same flag from inside the program, or from a test. Safe from any thread.
void RequestStop();

}  // namespace prospect::base
