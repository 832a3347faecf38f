#include "firmware/webhook/signature.hpp"

#include <gtest/gtest.h>

namespace traygauge::test {
namespace {

// RFC 4231, test cases 1, 2, 3 and 6.
TEST(Signature, IsHmacSha256) {
  EXPECT_EQ(hmac_sha256_hex(std::string(20, '\x0b'), "Hi There"),
            "b0344c61d8db38535ca8afceaf0bf12b881dc200c9833da726e9376c2e32cff7");
  EXPECT_EQ(hmac_sha256_hex("Jefe", "what do ya want for nothing?"),
            "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");
  EXPECT_EQ(hmac_sha256_hex(std::string(20, '\xaa'), std::string(50, '\xdd')),
            "773ea91e36800e46854db8ebd09181a72959098b3ef8c122d9635514ced565fe");
  EXPECT_EQ(
      hmac_sha256_hex(std::string(131, '\xaa'), "Test Using Larger Than Block-Size Key - Hash Key First"),
      "60e431591ee0b67f0d8a26aacbf5b77f8e0bc6213728c5140546040f0ee37f54");
}

// Python: hmac.new(b"whsec_0123456789abcdef", b"1795765200.{\"a\":1}", "sha256").hexdigest()
TEST(Signature, SignsTimeAndBody) {
  EXPECT_EQ(webhook_signature("whsec_0123456789abcdef", 1795765200, R"({"a":1})"),
            "t=1795765200,v1=581a835c7179875c4c44c48583da4008fb373ab48e7e608c3ba35713ff58b39a");
}

}  // namespace
}  // namespace traygauge::test
