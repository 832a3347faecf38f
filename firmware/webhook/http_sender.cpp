#include "firmware/webhook/http_sender.hpp"

#include <curl/curl.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

#include "firmware/webhook/send_problem.hpp"

namespace traygauge {
namespace {

using SteadyClock = std::chrono::steady_clock;
using CurlLong = long;  // NOLINT(google-runtime-int): libcurl reads its options as such

int curl_events(std::int16_t revents) {
  int events = 0;
  if ((revents & (POLLIN | POLLHUP)) != 0) events |= CURL_CSELECT_IN;
  if ((revents & POLLOUT) != 0) events |= CURL_CSELECT_OUT;
  if ((revents & (POLLERR | POLLNVAL)) != 0) events |= CURL_CSELECT_ERR;
  return events;
}

std::int16_t poll_events(int what) {
  int events = 0;
  if (what == CURL_POLL_IN || what == CURL_POLL_INOUT) events |= POLLIN;
  if (what == CURL_POLL_OUT || what == CURL_POLL_INOUT) events |= POLLOUT;
  return static_cast<std::int16_t>(events);
}

}  // namespace

// Stays where it is: libcurl keeps its address.
class HttpSender::Transfer {
 public:
  explicit Transfer(HttpSenderParams params) : params_(std::move(params)) {}
  Transfer(const Transfer&) = delete;
  Transfer& operator=(const Transfer&) = delete;
  ~Transfer() { leave(); }

  bool prepare();
  bool start(std::string body, const std::vector<std::string>& headers);
  bool is_busy() const { return is_busy_; }
  void add_descriptors(std::vector<pollfd>& descriptors) const {
    for (const auto& [socket, events] : sockets_) descriptors.push_back({socket, events, 0});
  }
  std::optional<std::chrono::milliseconds> timeout() const;
  std::optional<SendOutcome> attend();

 private:
  bool set_limits();
  bool set_trust();
  bool set_callbacks();
  template <class Value>
  bool set(CURLoption option, Value value) {
    return curl_easy_setopt(easy_.get(), option, value) == CURLE_OK;
  }
  void leave();
  SendOutcome outcome_of(CURLcode result);
  // Of head and body; false: more than are read.
  bool count(std::size_t bytes);

  static int on_socket(CURL* easy, curl_socket_t socket, int what, void* self, void* of_socket);
  static int on_timer(CURLM* multi, CurlLong timeout_ms, void* self);
  static std::size_t on_head(const char* data, std::size_t size, std::size_t count, void* self);
  static std::size_t on_body(const char* data, std::size_t size, std::size_t count, void* self);

  struct FreeHeaders {
    void operator()(curl_slist* list) const { curl_slist_free_all(list); }
  };
  struct FreeEasy {
    void operator()(CURL* easy) const { curl_easy_cleanup(easy); }
  };
  struct FreeMulti {
    void operator()(CURLM* multi) const { curl_multi_cleanup(multi); }
  };

  HttpSenderParams params_;
  std::string body_;
  std::array<char, CURL_ERROR_SIZE> detail_{};
  std::unique_ptr<curl_slist, FreeHeaders> headers_;
  std::map<curl_socket_t, std::int16_t> sockets_;
  std::optional<SteadyClock::time_point> deadline_;
  std::size_t read_bytes_ = 0;
  bool is_head_complete_ = false;
  bool is_busy_ = false;
  // The last members: they call back while they go.
  std::unique_ptr<CURLM, FreeMulti> multi_;
  std::unique_ptr<CURL, FreeEasy> easy_;
};

bool HttpSender::Transfer::prepare() {
  static const bool is_ready = curl_global_init(CURL_GLOBAL_DEFAULT) == CURLE_OK;
  if (!is_ready) return false;
  // OpenSSL writes to connections that the receiver has closed.
  std::signal(SIGPIPE, SIG_IGN);
  multi_.reset(curl_multi_init());
  easy_.reset(curl_easy_init());
  return multi_ != nullptr && easy_ != nullptr && set_limits() && set_trust() && set_callbacks();
}

bool HttpSender::Transfer::set_limits() {
  return set(CURLOPT_URL, params_.url.c_str()) && set(CURLOPT_PROTOCOLS_STR, "http,https") &&
         set(CURLOPT_HTTP_VERSION, CurlLong{CURL_HTTP_VERSION_1_1}) && set(CURLOPT_FOLLOWLOCATION, 0L) &&
         set(CURLOPT_PROXY, "") && set(CURLOPT_USERAGENT, "traygauge") &&
         set(CURLOPT_CONNECTTIMEOUT_MS, CurlLong{params_.connect_within.count()}) &&
         set(CURLOPT_TIMEOUT_MS, CurlLong{params_.answer_within.count()}) && set(CURLOPT_NOSIGNAL, 1L) &&
         // A thread that asks for a name is left behind, not waited for, where the name server hangs.
         set(CURLOPT_QUICK_EXIT, 1L);
}

bool HttpSender::Transfer::set_trust() {
  const bool is_set = set(CURLOPT_SSL_VERIFYPEER, 1L) && set(CURLOPT_SSL_VERIFYHOST, 2L) &&
                      set(CURLOPT_SSLVERSION, CurlLong{CURL_SSLVERSION_TLSv1_2});
  if (!is_set) return false;
  // libcurl's own defaults would be trusted beside.
  if (params_.trusted_file)
    return set(CURLOPT_CAINFO, params_.trusted_file->c_str()) && set(CURLOPT_CAPATH, nullptr);
  return set(CURLOPT_CAINFO, nullptr) && set(CURLOPT_CAPATH, params_.trusted_folder.c_str());
}

bool HttpSender::Transfer::set_callbacks() {
  void* const self = this;
  curl_multi_setopt(multi_.get(), CURLMOPT_SOCKETFUNCTION, &on_socket);
  curl_multi_setopt(multi_.get(), CURLMOPT_SOCKETDATA, self);
  curl_multi_setopt(multi_.get(), CURLMOPT_TIMERFUNCTION, &on_timer);
  curl_multi_setopt(multi_.get(), CURLMOPT_TIMERDATA, self);
  curl_multi_setopt(multi_.get(), CURLMOPT_MAXCONNECTS, 1L);
  return set(CURLOPT_HEADERFUNCTION, &on_head) && set(CURLOPT_HEADERDATA, self) &&
         set(CURLOPT_WRITEFUNCTION, &on_body) && set(CURLOPT_WRITEDATA, self) &&
         set(CURLOPT_ERRORBUFFER, detail_.data());
}

bool HttpSender::Transfer::start(std::string body, const std::vector<std::string>& headers) {
  body_ = std::move(body);
  read_bytes_ = 0;
  is_head_complete_ = false;
  detail_.front() = '\0';
  // Without an empty "Expect:" libcurl waits a second for leave to send a long body.
  curl_slist* list = curl_slist_append(nullptr, "Expect:");
  for (const std::string& header : headers) list = curl_slist_append(list, header.c_str());
  headers_.reset(list);
  set(CURLOPT_HTTPHEADER, list);
  set(CURLOPT_POSTFIELDS, body_.c_str());
  set(CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(body_.size()));
  is_busy_ = curl_multi_add_handle(multi_.get(), easy_.get()) == CURLM_OK;
  return is_busy_;
}

void HttpSender::Transfer::leave() {
  if (is_busy_) curl_multi_remove_handle(multi_.get(), easy_.get());
  is_busy_ = false;
}

std::optional<std::chrono::milliseconds> HttpSender::Transfer::timeout() const {
  if (!is_busy_ || !deadline_) return std::nullopt;
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(*deadline_ - SteadyClock::now());
  return std::max(left, std::chrono::milliseconds(0));
}

std::optional<SendOutcome> HttpSender::Transfer::attend() {
  if (!is_busy_) return std::nullopt;
  std::vector<pollfd> descriptors;
  add_descriptors(descriptors);
  ::poll(descriptors.data(), descriptors.size(), 0);
  int running = 0;
  for (const pollfd& ready : descriptors) {
    if (ready.revents != 0)
      curl_multi_socket_action(multi_.get(), ready.fd, curl_events(ready.revents), &running);
  }
  if (deadline_ && SteadyClock::now() >= *deadline_) {
    deadline_.reset();
    curl_multi_socket_action(multi_.get(), CURL_SOCKET_TIMEOUT, 0, &running);
  }
  int left = 0;
  const CURLMsg* const message = curl_multi_info_read(multi_.get(), &left);
  if (message == nullptr || message->msg != CURLMSG_DONE) return std::nullopt;
  const CURLcode result = message->data.result;  // removing the handle takes the message with it
  SendOutcome outcome = outcome_of(result);
  leave();
  return outcome;
}

// Once the head has come the receiver has said what it wanted to say, however its body goes on. A head that
// is cut off says nothing, though libcurl is content with its first line.
SendOutcome HttpSender::Transfer::outcome_of(CURLcode result) {
  CurlLong status = 0;
  curl_easy_getinfo(easy_.get(), CURLINFO_RESPONSE_CODE, &status);
  if (status >= 200 && is_head_complete_) return {static_cast<int>(status), {}};
  SendProblem problem;
  problem.code = result;
  problem.detail = detail_.data();
  problem.receiver = params_.shown;
  problem.is_too_long = read_bytes_ > params_.max_answer_bytes;
  CurlLong system_error = 0;
  curl_easy_getinfo(easy_.get(), CURLINFO_OS_ERRNO, &system_error);
  problem.system_error = static_cast<int>(system_error);
  curl_off_t begun_us = 0;
  curl_easy_getinfo(easy_.get(), CURLINFO_PRETRANSFER_TIME_T, &begun_us);
  problem.was_connected = begun_us > 0;
  return {0, describe(problem)};
}

bool HttpSender::Transfer::count(std::size_t bytes) {
  read_bytes_ += bytes;
  return read_bytes_ <= params_.max_answer_bytes;
}

int HttpSender::Transfer::on_socket(CURL* /*easy*/, curl_socket_t socket, int what, void* self,
                                    void* /*of_socket*/) {
  auto& sockets = static_cast<Transfer*>(self)->sockets_;
  if (what == CURL_POLL_REMOVE) {
    sockets.erase(socket);
  } else {
    sockets[socket] = poll_events(what);
  }
  return 0;
}

int HttpSender::Transfer::on_timer(CURLM* /*multi*/, CurlLong timeout_ms, void* self) {
  auto& deadline = static_cast<Transfer*>(self)->deadline_;
  deadline.reset();
  if (timeout_ms >= 0) deadline = SteadyClock::now() + std::chrono::milliseconds(timeout_ms);
  return 0;
}

std::size_t HttpSender::Transfer::on_head(const char* data, std::size_t size, std::size_t count, void* self) {
  auto& transfer = *static_cast<Transfer*>(self);
  const std::string_view line(data, size * count);
  // An interim head, such as 100, is followed by the one that counts.
  if (line.starts_with("HTTP/")) transfer.is_head_complete_ = false;
  if (line == "\r\n" || line == "\n") transfer.is_head_complete_ = true;
  return transfer.count(line.size()) ? line.size() : 0;
}

std::size_t HttpSender::Transfer::on_body(const char* /*data*/, std::size_t size, std::size_t count,
                                          void* self) {
  return static_cast<Transfer*>(self)->count(size * count) ? size * count : 0;
}

Expected<HttpSender> HttpSender::create(HttpSenderParams params) {
  auto transfer = std::make_unique<Transfer>(std::move(params));
  if (!transfer->prepare()) return Failure{"libcurl cannot be used for https; install Debian's libcurl4"};
  return HttpSender(std::move(transfer));
}

HttpSender::HttpSender(std::unique_ptr<Transfer> transfer) : transfer_(std::move(transfer)) {}
HttpSender::HttpSender(HttpSender&& other) noexcept = default;
HttpSender& HttpSender::operator=(HttpSender&& other) noexcept = default;
HttpSender::~HttpSender() = default;

bool HttpSender::start(std::string body, const std::vector<std::string>& headers) {
  return transfer_->start(std::move(body), headers);
}

bool HttpSender::is_busy() const {
  return transfer_->is_busy();
}

void HttpSender::add_descriptors(std::vector<pollfd>& descriptors) const {
  transfer_->add_descriptors(descriptors);
}

std::optional<std::chrono::milliseconds> HttpSender::timeout() const {
  return transfer_->timeout();
}

std::optional<SendOutcome> HttpSender::attend() {
  return transfer_->attend();
}

}  // namespace traygauge
