// What a receiver's answer means for the message.
#pragma once

#include <cstdint>
#include <string>

namespace traygauge {

enum class AnswerMeaning : std::uint8_t {
  delivered,
  failed,   // trying again soon may help
  refused,  // only a change at the receiver or of the address helps; the message is kept all the same
};

// By HTTP's status; 0: there was no answer.
AnswerMeaning meaning_of(int status);

// For people; of an answer that is no delivery.
std::string describe_answer(const std::string& receiver, int status);

}  // namespace traygauge
