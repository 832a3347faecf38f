#include "firmware/web/http_server.hpp"

#include <microhttpd.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <list>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include "firmware/web/acceptor.hpp"
#include "firmware/web/http_message.hpp"
#include "firmware/web/request_head.hpp"
#include "firmware/web/request_intake.hpp"
#include "firmware/web/web_connection.hpp"

namespace traygauge {
namespace {

using Clock = std::chrono::steady_clock;
using Phase = ConnectionProgress::Phase;

MHD_Result take_value(void* fields, MHD_ValueKind, const char* name, const char* value) noexcept {
  try {
    take_field(*static_cast<HeadFields*>(fields), name, value == nullptr ? "" : value);
    return MHD_YES;
  } catch (...) {
    return MHD_NO;  // out of memory: fields are missing, and what is missing grants nothing
  }
}

RequestHead head_of(MHD_Connection* handle, const char* method, std::string_view target) {
  RequestHead head{method, target, {}, 0};
  MHD_get_connection_values(handle, MHD_HEADER_KIND, &take_value, &head.fields);
  const auto* const size = MHD_get_connection_info(handle, MHD_CONNECTION_INFO_REQUEST_HEADER_SIZE);
  head.header_bytes = size == nullptr ? 0 : size->header_size;
  return head;
}

// parse_target() decodes, once.
std::size_t keep_escapes(void*, MHD_Connection*, char* text) noexcept {
  return std::char_traits<char>::length(text);
}

}  // namespace

class HttpServer::Daemon {
 public:
  Daemon(HttpLimits limits, std::vector<Listener> listeners, RequestHandler& handler)
      : limits_(std::move(limits)),
        handler_(handler),
        epoll_(::epoll_create1(EPOLL_CLOEXEC)),
        acceptor_(limits_, std::move(listeners), epoll_) {}
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;
  ~Daemon();

  Expected<void> start();
  int descriptor() const { return epoll_; }
  std::optional<std::chrono::milliseconds> timeout() const;
  void run();
  HttpCounts counts() const;
  const std::vector<Listener>& listeners() const { return acceptor_.listeners(); }

 private:
  struct Connection final : WebConnection {
    Connection(Daemon& owner, const AcceptedSocket& socket) : WebConnection(socket), daemon(owner) {}
    void wake() override { MHD_resume_connection(handle); }

    Daemon& daemon;
    MHD_Connection* handle = nullptr;
  };

  // What an answer is read from.
  struct Answer {
    Answer(Connection& sender, std::unique_ptr<ByteStream> body)
        : connection(sender), stream(std::move(body)) {}

    Connection& connection;
    std::unique_ptr<ByteStream> stream;
  };

  static Connection& connection_of(MHD_Connection* handle) {
    const auto* const info = MHD_get_connection_info(handle, MHD_CONNECTION_INFO_SOCKET_CONTEXT);
    return *static_cast<Connection*>(info->socket_context);
  }

  // Called by libmicrohttpd, which is C: none lets an exception through.
  static void* on_target(void* self, const char* target, MHD_Connection* handle) noexcept;
  static MHD_Result on_request(void* self, MHD_Connection* handle, const char* url, const char* method,
                               const char* version, const char* data, std::size_t* size,
                               void** context) noexcept;
  static void on_completed(void* self, MHD_Connection* handle, void** context,
                           MHD_RequestTerminationCode code) noexcept;
  static void on_connection(void* self, MHD_Connection* handle, void** context,
                            MHD_ConnectionNotificationCode code) noexcept;
  static ssize_t on_read(void* answer, std::uint64_t position, char* into, std::size_t size) noexcept;
  static void on_answer_over(void* answer) noexcept { delete static_cast<Answer*>(answer); }

  MHD_Result begin(Connection& connection, const char* method);
  MHD_Result finish(Connection& connection);
  static MHD_Result send(Connection& connection, HttpResponse response, bool then_close);
  void take_on(const AcceptedSocket& socket);
  void notice_ends() const;
  void sweep(SteadyTime now);

  HttpLimits limits_;
  RequestHandler& handler_;
  int epoll_ = -1;
  Acceptor acceptor_;
  MHD_Daemon* daemon_ = nullptr;
  std::list<Connection> connections_;
  HttpCounts counts_;
  SteadyTime next_sweep_;
  bool is_stopping_ = false;
};

Expected<void> HttpServer::Daemon::start() {
#if MHD_VERSION >= 0x00097707
  constexpr auto kStrictness = MHD_OPTION_CLIENT_DISCIPLINE_LVL;
  constexpr unsigned kOneThread = MHD_USE_NO_THREAD_SAFETY;  // else added connections are taken on later
#else
  constexpr auto kStrictness = MHD_OPTION_STRICT_FOR_CLIENT;
  constexpr unsigned kOneThread = 0;
#endif
  constexpr unsigned kFlags =
      MHD_USE_EPOLL | MHD_USE_NO_LISTEN_SOCKET | MHD_ALLOW_SUSPEND_RESUME | kOneThread;
  // is_overdue() comes first; this ends what it does not see, such as an error that libmicrohttpd answers.
  using std::chrono::seconds;
  const auto longest = std::max({limits_.max_head_time, limits_.max_body_time, limits_.max_stall});
  const auto idle_s = static_cast<unsigned>(std::chrono::ceil<seconds>(longest).count() + 1);
  // clang-format off
  daemon_ = MHD_start_daemon(kFlags, 0, nullptr, nullptr, &on_request, this,
                             kStrictness, 1,
                             MHD_OPTION_CONNECTION_LIMIT, limits_.max_connections,
                             MHD_OPTION_CONNECTION_MEMORY_LIMIT, limits_.connection_memory_bytes,
                             MHD_OPTION_CONNECTION_TIMEOUT, idle_s,
                             MHD_OPTION_UNESCAPE_CALLBACK, &keep_escapes, nullptr,
                             MHD_OPTION_URI_LOG_CALLBACK, &on_target, this,
                             MHD_OPTION_NOTIFY_COMPLETED, &on_completed, this,
                             MHD_OPTION_NOTIFY_CONNECTION, &on_connection, this,
                             MHD_OPTION_END);
  // clang-format on
  const auto* const info =
      daemon_ == nullptr ? nullptr : MHD_get_daemon_info(daemon_, MHD_DAEMON_INFO_EPOLL_FD);
  epoll_event event{EPOLLIN, {}};
  if (info == nullptr || ::epoll_ctl(epoll_, EPOLL_CTL_ADD, info->epoll_fd, &event) != 0)
    return Failure{"the web server cannot start: " + std::system_category().message(errno)};
  next_sweep_ = Clock::now() + limits_.sweep_interval;
  return {};
}

HttpServer::Daemon::~Daemon() {
  is_stopping_ = true;
  // To stop with suspended connections is an error of libmicrohttpd's user.
  for (Connection& connection : connections_) connection.close();
  if (daemon_ != nullptr) {
    MHD_run(daemon_);
    MHD_stop_daemon(daemon_);
  }
  if (epoll_ >= 0) ::close(epoll_);
}

std::optional<std::chrono::milliseconds> HttpServer::Daemon::timeout() const {
  using std::chrono::milliseconds;
  std::optional<milliseconds> earliest;
  MHD_UNSIGNED_LONG_LONG wait_ms = 0;
  if (MHD_get_timeout(daemon_, &wait_ms) == MHD_YES) earliest = milliseconds(wait_ms);
  if (connections_.empty() && !acceptor_.is_short_of_descriptors()) return earliest;
  const auto sweep = std::max(std::chrono::ceil<milliseconds>(next_sweep_ - Clock::now()), milliseconds(0));
  return earliest ? std::min(*earliest, sweep) : sweep;
}

void HttpServer::Daemon::run() {
  acceptor_.accept([this](const AcceptedSocket& socket) { take_on(socket); });
  MHD_run(daemon_);
  notice_ends();
  const SteadyTime now = Clock::now();
  if (now >= next_sweep_) sweep(now);
}

// libmicrohttpd 0.9.75 overlooks an end that comes together with data, and does not look at suspended
// connections.
void HttpServer::Daemon::notice_ends() const {
  std::array<epoll_event, 64> events{};
  const int count = ::epoll_wait(epoll_, events.data(), static_cast<int>(events.size()), 0);
  for (int i = 0; i < count; ++i) {
    auto* const connection = static_cast<Connection*>(events[static_cast<std::size_t>(i)].data.ptr);
    if (connection != nullptr) connection->note_end();  // null: listeners and libmicrohttpd's own
  }
}

void HttpServer::Daemon::sweep(SteadyTime now) {
  next_sweep_ = now + limits_.sweep_interval;
  acceptor_.try_again();
  for (Connection& connection : connections_) {
    connection.close_if_ended();
    if (connection.is_cut() || !is_overdue(connection.progress, limits_, now)) continue;
    ++counts_.overdue;
    connection.cut();
  }
  handler_.attend(now);
}

HttpCounts HttpServer::Daemon::counts() const {
  HttpCounts counts = counts_;
  counts.open = connections_.size();
  counts.refused_peers = acceptor_.refused();
  return counts;
}

// Accepted here: libmicrohttpd's own accept() copies beyond the address of a Unix socket's client that has a
// name.
void HttpServer::Daemon::take_on(const AcceptedSocket& socket) {
  ++counts_.connections;
  epoll_event event{EPOLLRDHUP | EPOLLET, {}};
  event.data.ptr = &connections_.emplace_back(*this, socket);
  ::epoll_ctl(epoll_, EPOLL_CTL_ADD, socket.descriptor, &event);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): the kernel's interface
  const auto* const address = reinterpret_cast<const sockaddr*>(&socket.address);
  // on_connection() finds the connection at the end of the list; where it was not called, the socket is
  // closed.
  const auto bytes = std::min<socklen_t>(socket.address_bytes, sizeof(socket.address));
  MHD_add_connection(daemon_, socket.descriptor, address, bytes);
  if (connections_.empty() || connections_.back().handle != nullptr) return;
  connections_.pop_back();
  acceptor_.forget(socket.peer);
}

void HttpServer::Daemon::on_connection(void* self, MHD_Connection* handle, void** context,
                                       MHD_ConnectionNotificationCode code) noexcept {
  auto& daemon = *static_cast<Daemon*>(self);
  if (code == MHD_CONNECTION_NOTIFY_STARTED) {
    daemon.connections_.back().handle = handle;
    *context = &daemon.connections_.back();
    return;
  }
  const auto* const closed = static_cast<Connection*>(*context);
  daemon.acceptor_.forget(closed->peer());
  daemon.connections_.remove_if([closed](const Connection& connection) { return &connection == closed; });
}

// The first that is known of a request.
void* HttpServer::Daemon::on_target(void*, const char* target, MHD_Connection* handle) noexcept {
  Connection& connection = connection_of(handle);
  try {
    connection.target = target == nullptr ? "" : target;
  } catch (...) {
    connection.target.clear();  // which is no target, and is refused
  }
  return nullptr;
}

MHD_Result HttpServer::Daemon::on_request(void* self, MHD_Connection* handle, const char*, const char* method,
                                          const char*, const char* data, std::size_t* size, void**) noexcept {
  auto& daemon = *static_cast<Daemon*>(self);
  Connection& connection = connection_of(handle);
  try {
    if (!connection.intake) return daemon.begin(connection, method);
    if (*size == 0) return daemon.finish(connection);
    const bool goes_on = connection.intake->take_body({data, *size});
    *size = 0;
    return goes_on ? MHD_YES : MHD_NO;
  } catch (...) {
    return MHD_NO;  // the connection is closed
  }
}

MHD_Result HttpServer::Daemon::begin(Connection& connection, const char* method) {
  connection.enter(Phase::body);
  RequestIntake& intake = connection.intake.emplace(limits_, handler_);
  const auto next = intake.begin(head_of(connection.handle, method, connection.target), connection.peer());
  if (next == RequestIntake::Next::body) return MHD_YES;
  ++counts_.refused_requests;
  return send(connection, intake.answer(), true);
}

MHD_Result HttpServer::Daemon::finish(Connection& connection) {
  ++(connection.intake->is_refused() ? counts_.refused_requests : counts_.requests);
  return send(connection, connection.intake->answer(), false);
}

MHD_Result HttpServer::Daemon::send(Connection& connection, HttpResponse response, bool then_close) {
  connection.enter(Phase::answer);
  SizedStream body = stream_of(std::move(response.body));
  body.stream->attach(connection);
  connection.progress.is_live = body.stream->is_live();
  auto answer = std::make_unique<Answer>(connection, std::move(body.stream));
  constexpr std::size_t kBlockBytes = 16UL * 1024;
  MHD_Response* const reply = MHD_create_response_from_callback(
      body.bytes.value_or(MHD_SIZE_UNKNOWN), kBlockBytes, &on_read, answer.get(), &on_answer_over);
  if (reply == nullptr) return MHD_NO;
  static_cast<void>(answer.release());  // on_answer_over() deletes it
  bool is_whole = true;
  const auto add_header = [&](const char* name, const std::string& value) {
    is_whole = is_whole && MHD_add_response_header(reply, name, value.c_str()) == MHD_YES;
  };
  add_header(MHD_HTTP_HEADER_SERVER, "traygauge");
  if (!response.content_type.empty()) add_header(MHD_HTTP_HEADER_CONTENT_TYPE, response.content_type);
  for (const auto& [name, value] : response.headers) add_header(name.c_str(), value);
  if (then_close) add_header(MHD_HTTP_HEADER_CONNECTION, "close");
  // What libmicrohttpd takes for no header could split the answer in two: the connection is closed.
  const auto status = static_cast<unsigned>(response.status);
  const MHD_Result queued = is_whole ? MHD_queue_response(connection.handle, status, reply) : MHD_NO;
  MHD_destroy_response(reply);
  return queued;
}

ssize_t HttpServer::Daemon::on_read(void* answer, std::uint64_t, char* into, std::size_t size) noexcept {
  Connection& connection = static_cast<Answer*>(answer)->connection;
  if (connection.daemon.is_stopping_ || connection.is_cut()) return MHD_CONTENT_READER_END_WITH_ERROR;
  try {
    const ByteStream::Piece piece = static_cast<Answer*>(answer)->stream->read({into, size});
    connection.progress.read_at = Clock::now();
    connection.progress.sent_bytes += piece.bytes;
    switch (piece.state) {
      case ByteStream::State::data:
        return static_cast<ssize_t>(piece.bytes);
      case ByteStream::State::end:
        return MHD_CONTENT_READER_END_OF_STREAM;
      case ByteStream::State::broken:
        return MHD_CONTENT_READER_END_WITH_ERROR;
      case ByteStream::State::waiting:
        break;
    }
    connection.progress.is_suspended = true;
    MHD_suspend_connection(connection.handle);
    return 0;
  } catch (...) {
    return MHD_CONTENT_READER_END_WITH_ERROR;
  }
}

void HttpServer::Daemon::on_completed(void*, MHD_Connection* handle, void**,
                                      MHD_RequestTerminationCode) noexcept {
  Connection& connection = connection_of(handle);
  connection.intake.reset();
  connection.enter(Phase::head);
  connection.close_if_ended();
}

Expected<HttpServer> HttpServer::start(HttpLimits limits, std::vector<Listener> listeners,
                                       RequestHandler& handler) {
  auto daemon = std::make_unique<Daemon>(std::move(limits), std::move(listeners), handler);
  const Expected<void> started = daemon->start();
  if (!started.ok()) return Failure{started.failure()};
  return HttpServer(std::move(daemon));
}

HttpServer::HttpServer(std::unique_ptr<Daemon> daemon) : daemon_(std::move(daemon)) {}
HttpServer::HttpServer(HttpServer&&) noexcept = default;
HttpServer::~HttpServer() = default;

int HttpServer::descriptor() const {
  return daemon_->descriptor();
}
std::optional<std::chrono::milliseconds> HttpServer::timeout() const {
  return daemon_->timeout();
}
void HttpServer::run() {
  daemon_->run();
}
HttpCounts HttpServer::counts() const {
  return daemon_->counts();
}
const std::vector<Listener>& HttpServer::listeners() const {
  return daemon_->listeners();
}

}  // namespace traygauge
