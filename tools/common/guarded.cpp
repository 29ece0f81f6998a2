#include "tools/common/guarded.h"

#include <c10/util/Exception.h>

#include <cstdio>
#include <stdexcept>
#include <string>

#include "model/dataset.h"
#include "model/weights_error.h"
#include "tools/common/extent.h"

namespace prospect::tools {
namespace {

int Tell(const char* program, const std::string& error, int code) {
  std::fprintf(stderr, "%s: %s\n", program, error.c_str());
  return code;
}

std::string FirstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

int Guarded(const char* program, const std::function<int()>& run, int others) {
  try {
    return run();
  } catch (const model::DataError& error) {
    return Tell(program, error.what(), kExitData);
  } catch (const model::WeightsError& error) {
    return Tell(program, error.what(), kExitWeights);
  } catch (const model::DiskError& error) {
    return Tell(program, error.what(), kExitDisk);
  } catch (const Interrupted& error) {
    return Tell(program, error.what(), kExitInterrupted);
  } catch (const std::invalid_argument& error) {
    return Tell(program, error.what(), kExitUsage);
  } catch (const std::range_error& error) {
    return Tell(program, error.what(), kExitFailed);
  } catch (const c10::Error& error) {  // as when the GPU's memory is full
    return Tell(program, FirstLine(error.what_without_backtrace()), kExitFailed);
  } catch (const std::exception& error) {
    return Tell(program, error.what(), others);
  }
}

}  // namespace prospect::tools
