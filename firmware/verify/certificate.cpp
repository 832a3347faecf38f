#include "firmware/verify/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "firmware/base/csv_fields.hpp"
#include "firmware/base/text.hpp"
#include "firmware/config/config_folder.hpp"
#include "firmware/evaluate/evaluation_files.hpp"
#include "firmware/evaluate/gnuplot.hpp"
#include "simulator/capture/content_hash.hpp"

namespace traygauge {
namespace {

enum class Sign : bool { plain, always };

std::string signed_text(double value, Sign sign) {
  if (std::isnan(value)) return "–";
  const std::string text = fixed(value, 2);
  return sign == Sign::always && !text.starts_with('-') ? "+" + text : text;
}

std::string interval_text(const std::optional<ConfidenceInterval>& interval, Sign sign) {
  if (!interval) return "too few scans";
  return signed_text(interval->low, sign) + " to " + signed_text(interval->high, sign);
}

// "+0.52 (+0.10 to +0.94)".
std::string figure_text(const VerifyFigure& figure, Sign sign) {
  return signed_text(figure.value, sign) + " (" + interval_text(figure.interval, sign) + ")";
}

// What a volume's text may not hold in a table of Markdown.
std::string cell(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '|' || c == '\\') safe += '\\';
    safe += c == '\n' ? ' ' : c;
  }
  return safe;
}

std::string verdict(const VerifyFigures& figures, const VerifyClass& wanted) {
  std::string text = find_shortcomings(figures, wanted).empty() ? "PASS" : "FAIL";
  text += std::string(" against class ") + wanted.name + " (" + std::string(wanted.use) + ")";
  const VerifyClass* const best = best_class(figures);
  if (best == nullptr) return text + "; no class is reached";
  return text + "; the strictest class that is reached is " + best->name;
}

std::string list_conditions(const VerifyRecord& record) {
  const VerifyHeader& header = record.header;
  std::string text = "| condition | |\n| --- | --- |\n";
  const auto row = [&](const std::string& name, const std::string& value) {
    text += "| " + cell(name) + " | " + cell(value) + " |\n";
  };
  row("program", "traygauge " + header.program);
  row("began", header.started);
  row("ended", record.scans.empty() ? "–" : record.scans.back().time);
  row("plan", header.plan.name + ", " + std::to_string(header.plan.steps.size()) + " steps");
  for (const VerifyCondition& condition : header.conditions) row(condition.name, condition.value);
  return text;
}

std::string list_bodies(const VerifyFigures& figures) {
  std::string text =
      "| body | volume ml | scans | bias % | MAPE % | farthest % | in 1 σ | in 2 σ | warned |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const BodyFigures& own : figures.bodies) {
    const auto share = [&](const VerifyFigure& figure) {
      return std::isnan(figure.value) ? std::string("–") : fixed(figure.value, 0) + " %";
    };
    text += "| " + cell(own.body.id) + " | " + fixed(own.body.volume_ml, 1) + " ± " +
            fixed(own.body.volume_sigma_ml, 1) + " | " + std::to_string(own.scans) + " | " +
            figure_text(own.bias, Sign::always) + " | " + figure_text(own.mape, Sign::plain) + " | " +
            signed_text(own.worst, Sign::always) + " | " + share(own.within_one) + " | " +
            share(own.within_two) + " | " + std::to_string(own.warned) + " |\n";
  }
  return text;
}

std::string limit_text(double limit) {
  return fixed(limit, limit == std::round(limit) ? 0 : 1);
}

// A row a figure: value, intervals, and the classes' limits.
std::string list_figures(const VerifyFigures& figures) {
  std::string text =
      "| over all bodies | value % | 95 % interval | with the bodies' uncertainty | class A | class B | "
      "class C |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n";
  const auto row = [&](const std::string& name, const VerifyFigure& figure, Sign sign, const char* bound,
                       double VerifyClass::*limit) {
    text += "| " + name + " | " + signed_text(figure.value, sign) + " | " +
            interval_text(figure.interval, sign) + " | " + interval_text(figure.wide, sign);
    for (const VerifyClass& own : kVerifyClasses)
      text += limit == nullptr ? " | –" : std::string(" | ") + bound + limit_text(own.*limit);
    text += " |\n";
  };
  row("bias", figures.bias, Sign::always, "± ", &VerifyClass::bias);
  if (const BodyFigures* const worst = figures.worst_body())
    row("bias of the worst body, " + cell(worst->body.id), worst->bias, Sign::always, "± ",
        &VerifyClass::body_bias);
  row("MAPE", figures.mape, Sign::plain, "≤ ", &VerifyClass::mape);
  row("CV of " + std::to_string(figures.repeats) + " repeats", figures.cv, Sign::plain, "≤ ",
      &VerifyClass::cv);
  row("volumes within one sigma", figures.within_one, Sign::plain, "", nullptr);
  row("volumes within two sigma", figures.within_two, Sign::plain, "≥ ", &VerifyClass::within_two);
  row("refused, of " + std::to_string(figures.attempts) + " attempts", figures.refused, Sign::plain, "≤ ",
      &VerifyClass::refused);
  return text;
}

std::string list_refusals(const VerifyRecord& record) {
  std::string text;
  for (const VerifyScan& scan : record.scans) {
    if (scan.is_measured) continue;
    text += "- " + scan.step + ", attempt " + std::to_string(scan.attempt) + ": " + scan.status +
            (scan.message.empty() ? "" : ". " + scan.message) + "\n";
  }
  return text.empty() ? "None.\n" : text;
}

constexpr std::string_view kExplanation =
    "An interval is of 95 %: Student's for means, chi-squared for the CV, Clopper and Pearson's for\n"
    "shares. It speaks of further scans of these bodies at these places, not of other shapes or\n"
    "foods. Shares are treated as if each scan were independent; scans of one body resemble each\n"
    "other, so their true intervals are wider. Each body weighs the same.\n\n"
    "The wider interval adds two standard deviations of the bodies' own volumes, as if all were wrong\n"
    "to the same side. A volume lies within sigma where it differs from the body's by no more than\n"
    "the root of the sum of the squares of the scan's standard deviation and the body's. Repeats\n"
    "count for the CV and the refusals alone.\n\n"
    "A class is reached where the end of the wider interval keeps each limit, and the bias of each\n"
    "body its own. A, for portions and nutrients: the volume is then surer than the density of most\n"
    "foods. B, for portions: two portions that differ by a tenth are told apart. C, for consumption\n"
    "and waste in the mean. The limits are Traygauge's own. OIML R 129 is about instruments that\n"
    "measure the smallest box around an object, to charge for freight: none of its classes is claimed\n"
    "here.\n";

}  // namespace

std::string compose_summary(const VerifyFigures& figures, const VerifyClass& wanted) {
  std::string text = verdict(figures, wanted) + ".\n";
  text += "  bias " + figure_text(figures.bias, Sign::always) + " %, MAPE " +
          figure_text(figures.mape, Sign::plain) + " %, CV " + figure_text(figures.cv, Sign::plain) + " %\n";
  text += "  within two sigma " + figure_text(figures.within_two, Sign::plain) + " %, refused " +
          figure_text(figures.refused, Sign::plain) + " %\n";
  for (const std::string& fault : find_shortcomings(figures, wanted)) text += "  " + fault + "\n";
  return text;
}

std::string compose_certificate(const VerifyRecord& record, const VerifyFigures& figures,
                                const VerifyClass& wanted) {
  std::string text = "# Acceptance test of a Traygauge station\n\n**" + verdict(figures, wanted) + ".**\n\n";
  for (const std::string& fault : find_shortcomings(figures, wanted)) text += "- " + fault + "\n";
  if (!text.ends_with("\n\n")) text += "\n";
  text += "## Conditions\n\n" + list_conditions(record);
  text += "\n## Figures\n\n" + list_figures(figures);
  text += "\n" + list_bodies(figures) + "\nIn brackets the 95 % interval.\n";
  text += "\n![Errors by body](errors.svg)\n\n![Repeats](repeats.svg)\n";
  text += "\n## Bodies\n\n";
  for (const BodyFigures& own : figures.bodies) {
    text += "- " + own.body.id + ": " + own.body.origin + ", " + fixed(own.body.volume_ml, 2) +
            " ml, standard deviation " + fixed(own.body.volume_sigma_ml, 2) + " ml\n";
  }
  text += "\n## Refused attempts\n\n" + list_refusals(record);
  text += "\n## How to read it\n\n" + std::string(kExplanation);
  text += "\nThe scans are in scans.csv, digest " + content_hash(compose_scans_csv(record)) + ".\n";
  text += "\nTester: ____________________    Inspector: ____________________    Date: ____________\n";
  return text;
}

std::string compose_scans_csv(const VerifyRecord& record) {
  std::string text =
      "step,body,body_number,place,angle_deg,is_repeat,attempt,time,status,body_ml,body_sigma_ml,volume_ml,"
      "sigma_ml,"
      "signed_error_percent,sigma_percent,warnings\n";
  const VerifyPlan& plan = record.header.plan;
  for (const VerifyScan& scan : record.scans) {
    const VerifyStep& step = *std::ranges::find(plan.steps, scan.step, &VerifyStep::id);
    const VerifyBody& body = plan.bodies[step.body];
    std::string warnings;
    for (const std::string& warning : scan.warnings) warnings += (warnings.empty() ? "" : " ") + warning;
    text += csv_field(scan.step) + "," + csv_field(body.id) + "," + std::to_string(step.body) + "," +
            csv_field(plan.places[step.place].name) + "," + fixed(step.angle_deg, 1) + "," +
            (step.is_repeat ? "1" : "0") + "," + std::to_string(scan.attempt) + "," + csv_field(scan.time) +
            "," + csv_field(scan.status) + "," + fixed(body.volume_ml, 3) + "," +
            fixed(body.volume_sigma_ml, 3);
    if (scan.is_measured) {
      text += "," + fixed(scan.volume_ml, 3) + "," + fixed(scan.sigma_ml, 3) + "," +
              fixed(verify_error(scan, body), 3) + "," + fixed(100.0 * scan.sigma_ml / body.volume_ml, 3);
    } else {
      text += ",,,,";
    }
    text += "," + csv_field(warnings) + "\n";
  }
  return text;
}

void write_certificate(const std::filesystem::path& folder, const VerifyRecord& record,
                       const VerifyFigures& figures, const VerifyClass& wanted, const std::string& config,
                       std::ostream& log) {
  const std::filesystem::path scripts = find_plots_folder(config);
  create_folder(folder);
  const std::filesystem::path scans = folder / "scans.csv";
  write_text_file(scans, compose_scans_csv(record));
  write_text_file(folder / "certificate.md", compose_certificate(record, figures, wanted));
  draw_plots({{scripts / "verify_errors.gp", scans, folder / "errors.svg", {}},
              {scripts / "verify_repeats.gp", scans, folder / "repeats.svg", {}}},
             log);
}

}  // namespace traygauge
