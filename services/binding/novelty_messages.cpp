#include "services/binding/novelty_messages.h"

namespace prospect::services {

novelty_t ToMessage(const model::Novelty& novelty) {
  novelty_t message{};
  message.p = novelty.p;
  message.error = novelty.error;
  message.error_limit = novelty.error_limit;
  message.residual = novelty.residual;
  message.residual_limit = novelty.residual_limit;
  message.state = novelty.state;
  message.state_limit = novelty.state_limit;
  return message;
}

model::Novelty FromMessage(const novelty_t& message) {
  return {message.p,          message.error,          message.error_limit,
          message.residual,   message.residual_limit, message.state,
          message.state_limit};
}

}  // namespace prospect::services
