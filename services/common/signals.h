#pragma once

#include "base/stop_signals.h"

namespace prospect::services {

using base::InstallStopSignals;
using base::RequestStop;
using base::StopRequested;

}  // namespace prospect::services
