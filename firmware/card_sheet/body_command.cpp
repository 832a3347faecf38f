#include "firmware/card_sheet/body_command.hpp"

#include <ostream>

#include "firmware/base/exit_status.hpp"
#include "firmware/card_sheet/body_page.hpp"
#include "firmware/command/program.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {

void add_bodies_command(Program& program, BodyOptions& options) {
  Command verify = program.add_command("verify", "Test a station with bodies of known volume");
  Command command = verify.add_command("bodies", "The proof bodies as a PDF to print, cut, fold and glue");
  command.add_option("-o,--out", options.out, "The PDF").show_default();
  command.add_option("--paper", options.paper, "a4 or letter").show_default();
}

int run_bodies(const BodyOptions& options, std::ostream& out) {
  write_body_sheets(options.out, choose_paper(options.paper));
  out << printable(options.out.string()) << ": to print at 100 %, not fitted to the page.\n";
  for (const ProofBody& body : proof_bodies())
    out << "  " << describe_body(body) << " (" << describe_size(body) << ")\n";
  return kExitMeasured;
}

}  // namespace traygauge
