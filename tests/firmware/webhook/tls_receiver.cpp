#include "tests/firmware/webhook/tls_receiver.hpp"

#include <openssl/pem.h>
#include <openssl/x509v3.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <cstdio>
#include <stdexcept>

#include "tests/firmware/webhook/receiver.hpp"

namespace traygauge::test {

Certificate::Certificate(const std::string& host, int valid_s)
    : key_(EVP_EC_gen("P-256")), certificate_(X509_new()) {
  constexpr long kHourS = 3600;
  X509* const made = certificate_.get();
  X509_set_version(made, X509_VERSION_3);
  ASN1_INTEGER_set(X509_get_serialNumber(made), 1);
  X509_gmtime_adj(X509_getm_notBefore(made), -kHourS);
  X509_gmtime_adj(X509_getm_notAfter(made), valid_s);
  X509_set_pubkey(made, key_.get());
  X509_NAME* const name = X509_get_subject_name(made);
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, reinterpret_cast<const unsigned char*>(host.c_str()),
                             -1, -1, 0);
  X509_set_issuer_name(made, name);
  const std::unique_ptr<X509_EXTENSION, FreeBy<X509_EXTENSION_free>> names(
      X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name, ("DNS:" + host).c_str()));
  X509_add_ext(made, names.get(), -1);
  if (X509_sign(made, key_.get(), EVP_sha256()) == 0) throw std::runtime_error("no certificate can be made");
}

void Certificate::write(const std::filesystem::path& file) const {
  std::FILE* const stream = std::fopen(file.c_str(), "w");
  if (stream == nullptr || PEM_write_X509(stream, certificate_.get()) == 0)
    throw std::runtime_error(file.string() + " cannot be written");
  std::fclose(stream);
}

void Certificate::write_key(const std::filesystem::path& file) const {
  std::FILE* const stream = std::fopen(file.c_str(), "w");
  if (stream == nullptr ||
      PEM_write_PrivateKey(stream, key_.get(), nullptr, nullptr, 0, nullptr, nullptr) == 0)
    throw std::runtime_error(file.string() + " cannot be written");
  std::fclose(stream);
}

void Certificate::link_into(const std::filesystem::path& folder) const {
  char name[16];
  std::snprintf(name, sizeof(name), "%08lx.0", X509_subject_name_hash(certificate_.get()));
  std::filesystem::create_directories(folder);
  write(folder / name);
}

TlsReceiver::TlsReceiver(const Certificate& certificate)
    : listener_(listen_anywhere(port_)), context_(SSL_CTX_new(TLS_server_method())) {
  SSL_CTX_use_certificate(context_.get(), certificate.certificate());
  SSL_CTX_use_PrivateKey(context_.get(), certificate.key());
  thread_ = std::thread([this] { serve(); });
}

TlsReceiver::~TlsReceiver() {
  stop_ = true;
  thread_.join();
}

void TlsReceiver::serve() {
  while (!stop_) {
    pollfd ready{listener_.number(), POLLIN, 0};
    if (::poll(&ready, 1, 10) != 1) continue;
    const FileDescriptor socket(::accept4(listener_.number(), nullptr, nullptr, SOCK_CLOEXEC));
    const timeval longest{1, 0};
    ::setsockopt(socket.number(), SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof(longest));
    const std::unique_ptr<SSL, FreeBy<SSL_free>> connection(SSL_new(context_.get()));
    SSL_set_fd(connection.get(), socket.number());
    char buffer[4096];
    if (SSL_accept(connection.get()) != 1 || SSL_read(connection.get(), buffer, sizeof(buffer)) <= 0)
      continue;
    const std::string answer = "HTTP/1.1 200 OK\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";
    SSL_write(connection.get(), answer.data(), static_cast<int>(answer.size()));
    SSL_shutdown(connection.get());
    ++answered_;
  }
}

}  // namespace traygauge::test
