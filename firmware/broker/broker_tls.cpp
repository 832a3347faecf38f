#include "firmware/broker/broker_tls.hpp"

#include <arpa/inet.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>

#include <array>

namespace traygauge {
namespace {

bool is_literal_address(const std::string& host) {
  std::array<unsigned char, sizeof(in6_addr)> bytes{};
  return ::inet_pton(AF_INET, host.c_str(), bytes.data()) == 1 ||
         ::inet_pton(AF_INET6, host.c_str(), bytes.data()) == 1;
}

Failure of_file(const BrokerConfig& config, const char* key, const std::filesystem::path& file,
                const std::string& expected) {
  std::array<char, 256> reason{};
  ERR_error_string_n(ERR_peek_last_error(), reason.data(), reason.size());
  ERR_clear_error();
  return {config.table + "." + key + ": " + file.string() + ": expected " + expected + ", found none (" +
          reason.data() + ")"};
}

}  // namespace

struct BrokerTls::Callbacks {
  static BrokerTls* of(const SSL* ssl) {
    return static_cast<BrokerTls*>(SSL_CTX_get_app_data(SSL_get_SSL_CTX(ssl)));
  }
  static int on_verified(int is_valid, X509_STORE_CTX* store) {
    if (is_valid == 0) {
      const auto* const ssl =
          static_cast<SSL*>(X509_STORE_CTX_get_ex_data(store, SSL_get_ex_data_X509_STORE_CTX_idx()));
      of(ssl)->distrust_ = X509_verify_cert_error_string(X509_STORE_CTX_get_error(store));
    }
    return is_valid;
  }
  // libmosquitto tells the broker the address that it connects to instead of the name.
  static void on_progress(const SSL* ssl, int where, int /*value*/) {
    if ((where & SSL_CB_HANDSHAKE_START) == 0) return;
    BrokerTls& self = *of(ssl);
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): OpenSSL lends it so to this callback alone
    SSL_ctrl(const_cast<SSL*>(ssl), SSL_CTRL_SET_TLSEXT_HOSTNAME, TLSEXT_NAMETYPE_host_name,
             self.is_literal_ ? nullptr : self.config_.host.data());
  }
};

void BrokerTls::Free::operator()(ssl_ctx_st* context) const {
  SSL_CTX_free(context);
}

BrokerTls::BrokerTls(const BrokerConfig& config)
    : config_(config),
      context_(SSL_CTX_new(TLS_client_method())),
      is_literal_(is_literal_address(config.host)) {}

Expected<std::unique_ptr<BrokerTls>> BrokerTls::create(const BrokerConfig& config) {
  std::unique_ptr<BrokerTls> tls(new BrokerTls(config));
  SSL_CTX* const context = tls->context();
  if (context == nullptr || SSL_CTX_set_min_proto_version(context, TLS1_2_VERSION) != 1)
    return Failure{"OpenSSL cannot be used; install Debian's libssl3"};
  SSL_CTX_set_app_data(context, tls.get());
  // Buffers are given back while nothing is said.
  SSL_CTX_set_mode(context, SSL_MODE_RELEASE_BUFFERS);
  SSL_CTX_set_info_callback(context, &Callbacks::on_progress);
  SSL_CTX_set_verify(context, SSL_VERIFY_PEER, &Callbacks::on_verified);
  if (Expected<void> trusted = tls->trust(); !trusted.ok()) return Failure{trusted.failure()};
  if (Expected<void> known = tls->identify(); !known.ok()) return Failure{known.failure()};
  return tls;
}

Expected<void> BrokerTls::trust() {
  X509_VERIFY_PARAM* const wanted = SSL_CTX_get0_param(context());
  const int is_set = is_literal_ ? X509_VERIFY_PARAM_set1_ip_asc(wanted, config_.host.c_str())
                                 : X509_VERIFY_PARAM_set1_host(wanted, config_.host.c_str(), 0);
  if (is_set != 1) return Failure{config_.table + ".host: no certificate can be valid for it"};
  if (!config_.trusted) {
    SSL_CTX_set_default_verify_paths(context());
  } else if (SSL_CTX_load_verify_file(context(), config_.trusted->c_str()) != 1) {
    return of_file(config_, "ca", *config_.trusted, "certificates in PEM");
  }
  return {};
}

Expected<void> BrokerTls::identify() {
  if (!config_.certificate) return {};
  if (SSL_CTX_use_certificate_chain_file(context(), config_.certificate->c_str()) != 1)
    return of_file(config_, "certificate", *config_.certificate, "a certificate in PEM");
  // A key with a passphrase would ask on a terminal.
  SSL_CTX_set_default_passwd_cb(context(), [](char*, int, int, void*) { return 0; });
  if (SSL_CTX_use_PrivateKey_file(context(), config_.certificate_key->c_str(), SSL_FILETYPE_PEM) != 1)
    return of_file(config_, "certificate_key", *config_.certificate_key,
                   "the key of the certificate in PEM, without a passphrase");
  return {};
}

std::string BrokerTls::own_end() const {
  const X509* const own = SSL_CTX_get0_certificate(context());
  if (own == nullptr || X509_cmp_current_time(X509_get0_notAfter(own)) > 0) return {};
  return "This program's own certificate has ended: replace " + config_.table + ".certificate, " +
         config_.certificate->string() + ", and start it anew.";
}

}  // namespace traygauge
