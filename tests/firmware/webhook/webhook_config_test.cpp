#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "firmware/base/back_off.hpp"
#include "firmware/config/hub_tables.hpp"
#include "firmware/webhook/webhook.hpp"
#include "simulator/capture/input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSecret = "0123456789abcdefghij";

class WebhookConfigTest : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text, fs::perms perms = fs::perms::owner_read) {
    const fs::path file = folder_.path() / name;
    fs::remove(file);
    std::ofstream(file) << text;
    fs::permissions(file, perms);
    return file;
  }
  std::optional<WebhookConfig> read(const std::string& lines) {
    const fs::path file = write("station.toml",
                                "[station]\nname = \"a\"\nsocket = \"s\"\nfolder = \"f\"\n"
                                "[hub]\nstore = \"r.db\"\n" +
                                    lines);
    return read_hub_file(file, file).hub.webhook;
  }
  std::string error_of(const std::string& lines) {
    try {
      const std::optional<WebhookConfig> config = read(lines);
      if (!config) return "no webhook";
      const Expected<void> checked = Webhook::check(*config);
      return checked.ok() ? "none" : checked.failure();
    } catch (const InputError& error) {
      return error.what();
    }
  }
  static bool has_all(const std::string& text, std::initializer_list<std::string> parts) {
    return std::all_of(parts.begin(), parts.end(),
                       [&](const std::string& part) { return text.find(part) != std::string::npos; });
  }
  TemporaryFolder folder_;
};

TEST_F(WebhookConfigTest, IsReadFromTheHubsTable) {
  EXPECT_FALSE(read(""));
  const auto config = read(
      "webhook = \"https://till.example/scans\"\nwebhook_secret = \"a/key\"\n"
      "webhook_ca = \"/etc/ca.pem\"\n");
  ASSERT_TRUE(config);
  EXPECT_EQ(config->address, "https://till.example/scans");
  EXPECT_EQ(config->secret, folder_.path() / "a/key");
  EXPECT_EQ(config->trusted, "/etc/ca.pem");
}

TEST_F(WebhookConfigTest, ErrorsNameKeyAndFileAndNeverTheSecret) {
  const std::string webhook = "webhook = \"https://till.example/scans\"\n";
  for (const char* const wrong :
       {"till2.example", "ftp://till.example", "https://?key=1", "https:///scans2", "https://till.example:0/",
        "https://till.example:70000/", "https://ti ll/", "https://till.example/#here", "https://[::1/",
        "https://t\u00fcll.example/"}) {
    const std::string error = error_of("webhook = \"" + std::string(wrong) + "\"\n");
    EXPECT_TRUE(has_all(error, {"station.toml", "hub.webhook", "an address such as", "found"})) << error;
    EXPECT_EQ(error.find(wrong), std::string::npos) << error;
  }
  EXPECT_TRUE(has_all(error_of("webhook_secret = \"key\"\n"), {"station.toml", "hub.webhook_secret"}));
  EXPECT_TRUE(has_all(error_of("webhook_ca = \"ca\"\n"), {"station.toml", "hub.webhook_ca"}));
  const auto error_with_secret = [&](const std::string& text, fs::perms perms) {
    write("key", text, perms);
    return error_of(webhook + "webhook_secret = \"key\"\n");
  };
  EXPECT_EQ(error_with_secret(std::string(kSecret) + "\n", fs::perms::owner_read), "none");
  EXPECT_TRUE(has_all(error_with_secret(kSecret, fs::perms::owner_read | fs::perms::group_read),
                      {"hub.webhook_secret", "/key", "chmod 600"}));
  EXPECT_TRUE(has_all(error_with_secret("too-short", fs::perms::owner_read),
                      {"hub.webhook_secret", "/key", "expected one line of 20 to 128", "found 9"}));
  const std::string spaced = error_with_secret("two words that are a secret", fs::perms::owner_read);
  EXPECT_TRUE(has_all(spaced, {"hub.webhook_secret", "/key", "without spaces"})) << spaced;
  EXPECT_EQ(spaced.find("two words"), std::string::npos);
  EXPECT_TRUE(has_all(error_of(webhook + "webhook_secret = \"absent\"\n"),
                      {"hub.webhook_secret", "/absent", "cannot be read"}));
  EXPECT_TRUE(has_all(error_of(webhook + "webhook_ca = \"absent\"\n"),
                      {"hub.webhook_ca", "/absent", "cannot be read"}));
  write("ca.pem", "no certificate");
  EXPECT_TRUE(has_all(error_of(webhook + "webhook_ca = \"ca.pem\"\n"),
                      {"hub.webhook_ca", "/ca.pem", "expected certificates in PEM, found none"}));
}

TEST(WebhookAddress, KnowsWhatMayBeShownAndWhatIsThisMachine) {
  const auto shown = [](const char* text) { return parse_webhook_address(text)->shown; };
  EXPECT_EQ(shown("https://till.example/scans?key=1"), "https://till.example");
  EXPECT_EQ(shown("https://till.example:8443?key=1"), "https://till.example:8443");
  EXPECT_EQ(shown("http://user:pass@word@till.example/"), "http://till.example");
  EXPECT_EQ(shown("http://[fe80::1]:80/a"), "http://[fe80::1]:80");
  for (const char* const own : {"http://localhost", "http://127.0.0.1:80/", "http://127.9.9.9",
                                "http://[::1]/", "http://till.localhost"})
    EXPECT_TRUE(parse_webhook_address(own)->is_local) << own;
  for (const char* const other : {"http://till", "http://127.0.0.1.example", "http://[::2]/",
                                  "http://localhost@till.example/", "http://10.0.0.1"})
    EXPECT_FALSE(parse_webhook_address(other)->is_local) << other;
  EXPECT_TRUE(parse_webhook_address("https://a")->is_encrypted);
}

TEST(BackOff, DoublesUpToTheLongestAndIsShortenedByAQuarterAtMost) {
  using std::chrono::milliseconds;
  for (std::uint32_t seed = 1; seed < 200; ++seed) {
    BackOff back_off(milliseconds(1000), milliseconds(300'000), seed);
    for (const int full : {1000, 2000, 4000, 8000, 16000, 32000, 64000, 128000, 256000, 300'000, 300'000}) {
      const milliseconds wait = back_off.after_failure();
      ASSERT_LE(wait, milliseconds(full));
      ASSERT_GE(wait, milliseconds(full * 3 / 4));
    }
    back_off.reset();
    ASSERT_LE(back_off.after_failure(), milliseconds(1000));
    ASSERT_GE(back_off.after_refusal(), milliseconds(225'000));
    ASSERT_GE(back_off.after_failure(), milliseconds(225'000));
  }
}

}  // namespace
}  // namespace traygauge::test
