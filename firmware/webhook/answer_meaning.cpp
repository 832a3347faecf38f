#include "firmware/webhook/answer_meaning.hpp"

namespace traygauge {
namespace {

constexpr int kRequestTimeout = 408;
constexpr int kGone = 410;
constexpr int kTooEarly = 425;
constexpr int kTooManyRequests = 429;

}  // namespace

AnswerMeaning meaning_of(int status) {
  if (status >= 200 && status < 300) return AnswerMeaning::delivered;
  if (status == kRequestTimeout || status == kTooEarly || status == kTooManyRequests)
    return AnswerMeaning::failed;
  return status >= 400 && status < 500 ? AnswerMeaning::refused : AnswerMeaning::failed;
}

std::string describe_answer(const std::string& receiver, int status) {
  const std::string answered = receiver + " answered " + std::to_string(status);
  if (status >= 300 && status < 400)
    return answered +
           ", a redirect, which is not followed: write the address that it leads to in hub.webhook.";
  if (status == kGone)
    return answered + ": nobody is there any more. Correct hub.webhook, or remove it, with what waits.";
  if (meaning_of(status) == AnswerMeaning::refused)
    return answered + ": it refuses what it is told. Correct the receiver or hub.webhook.";
  return answered + ".";
}

}  // namespace traygauge
