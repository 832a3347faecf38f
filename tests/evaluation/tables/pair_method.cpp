#include "tests/evaluation/tables/pair_method.hpp"

namespace traygauge::tables {
namespace {

class OurMethod final : public PairMethod {
 public:
  OurMethod(const PairTask& task, const Variant& variant, const std::string& config)
      : runner_(task, options_of(variant, config)) {}
  Run measure(std::uint64_t seed) override { return runner_.measure(seed); }

 private:
  static ProtocolOptions options_of(const Variant& variant, const std::string& config) {
    ProtocolOptions options;
    options.parameters = configure(variant);
    options.profile = abilities_of(variant.profile);
    options.config = config;
    return options;
  }

  PairRunner runner_;
};

}  // namespace

std::unique_ptr<PairMethod> open_pair(const PairTask& task, const Variant& variant,
                                      const std::string& config) {
  return std::make_unique<OurMethod>(task, variant, config);
}

}  // namespace traygauge::tables
