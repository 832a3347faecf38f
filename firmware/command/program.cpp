#include "firmware/command/program.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <new>
#include <ostream>
#include <string_view>

#include "firmware/base/exit_status.hpp"
#include "firmware/command/similar_word.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

constexpr const char* kNotWritten = "the result could not be written to standard output";
constexpr const char* kDescribe = "--describe";

// A line for each option: its command's words, its names, what it takes, whether it has to be given, its
// default, its variable, its sentence; tabs between.
void describe_options(const CLI::App& app, const std::string& words, std::ostream& out) {
  for (const CLI::Option* const option : app.get_options({})) {
    const bool is_argument = option->get_positional();
    const bool is_flag = option->get_items_expected_max() == 0;
    out << "option\t" << words << '\t';
    if (is_argument) {
      out << option->get_single_name();
    } else {
      const char* separator = "";
      for (const std::string& name : option->get_snames()) {
        out << separator << '-' << name;
        separator = ",";
      }
      for (const std::string& name : option->get_lnames()) {
        out << separator << "--" << name;
        separator = ",";
      }
    }
    out << '\t'
        << (is_argument ? "argument"
            : is_flag   ? "flag"
                        : "value")
        << '\t' << (option->get_required() ? "required" : "optional") << '\t' << option->get_default_str()
        << '\t' << option->get_envname() << '\t' << option->get_description() << '\n';
  }
}

void describe_commands(const CLI::App& app, const std::string& words, std::ostream& out) {
  out << "command\t" << words << '\t' << app.get_description() << '\n';
  describe_options(app, words, out);
  for (const CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; }))
    describe_commands(*command, words + (words.empty() ? "" : " ") + command->get_name(), out);
}

}  // namespace

CommandOption& CommandOption::required() {
  option_->required();
  return *this;
}

CommandOption& CommandOption::range(int min, int max) {
  option_->check(CLI::Range(min, max));
  return *this;
}

CommandOption& CommandOption::range(double min, double max) {
  option_->check(CLI::Range(min, max));
  return *this;
}

CommandOption& CommandOption::positive() {
  option_->check(CLI::PositiveNumber);
  return *this;
}

CommandOption& CommandOption::environment(const std::string& name) {
  option_->envname(name);
  return *this;
}

CommandOption& CommandOption::several() {
  option_->take_all();
  return *this;
}

CommandOption& CommandOption::show_default() {
  option_->capture_default_str();
  return *this;
}

CommandOption& CommandOption::excludes(const CommandOption& other) {
  option_->excludes(other.option_);
  return *this;
}

CommandOption Command::add_option(const std::string& name, std::string& value, const std::string& text) {
  return CommandOption(*app_->add_option(name, value, text));
}

CommandOption Command::add_option(const std::string& name, std::filesystem::path& value,
                                  const std::string& text) {
  return CommandOption(*app_->add_option(name, value, text));
}

CommandOption Command::add_option(const std::string& name, std::vector<std::string>& value,
                                  const std::string& text) {
  return CommandOption(*app_->add_option(name, value, text));
}

CommandOption Command::add_option(const std::string& name, int& value, const std::string& text) {
  return CommandOption(*app_->add_option(name, value, text));
}

CommandOption Command::add_option(const std::string& name, std::uint64_t& value, const std::string& text) {
  return CommandOption(*app_->add_option(name, value, text));
}

CommandOption Command::add_option(const std::string& name, double& value, const std::string& text) {
  return CommandOption(*app_->add_option(name, value, text));
}

CommandOption Command::add_flag(const std::string& name, bool& value, const std::string& text) {
  return CommandOption(*app_->add_flag(name, value, text));
}

CommandOption Command::add_action(const std::string& name, const std::function<void()>& action,
                                  const std::string& text) {
  return CommandOption(*app_->add_flag_callback(name, action, text));
}

void Command::take_nothing() {
  app_->set_help_flag();
  app_->prefix_command();
}

Program::Program(const std::string& text, const std::string& name)
    : app_(std::make_unique<CLI::App>(text, name)) {
  app_->require_subcommand(1);
}

Program::~Program() = default;

void Program::add_version(const std::string& version) {
  app_->set_version_flag("--version", version);
}

Command Command::add_command(const std::string& name, const std::string& text) {
  app_->require_subcommand(1);
  return Command(*app_->add_subcommand(name, text));
}

Command Program::add_command(const std::string& name, const std::string& text) {
  return Command(*app_->add_subcommand(name, text));
}

Command Program::whole() {
  return Command(*app_);
}

void Program::take_options_after_commands() {
  app_->fallthrough();
}

int Program::run(int argument_count, const char* const* arguments, const std::function<int()>& action,
                 std::ostream& out, std::ostream& error) {
  const auto fail = [&](const std::string& text) {
    error << app_->get_name() << ": " << printable(text) << "\n";
    return kExitWrongUse;
  };
  try {
    if (argument_count == 2 && std::string_view(arguments[1]) == kDescribe) {
      describe_commands(*app_, "", out);
      out.flush();
      return out ? kExitMeasured : fail(kNotWritten);
    }
    app_->parse(argument_count, arguments);
    const int status = action();
    out.flush();
    return out ? status : fail(kNotWritten);
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == 0) {  // --help, --version
      const int status = app_->exit(problem, out, error);
      out.flush();
      return out ? status : fail(kNotWritten);
    }
    if (const std::string unknown = name_unknown_command(argument_count, arguments); !unknown.empty())
      return fail(unknown);
    return fail(std::string(problem.what()) + "; see " + app_->get_name() + " --help");
  } catch (const std::bad_alloc&) {
    return fail("too little memory for pictures of this size; see traygauge memory");
  } catch (const std::exception& problem) {  // UsageError, InputError, OutputError
    return fail(problem.what());
  }
}

// A word where a command is due, and what may have been meant; empty where every such word is one.
std::string Program::name_unknown_command(int argument_count, const char* const* arguments) const {
  const auto commands_of = [](const CLI::App* app) {
    return app->get_subcommands([](const CLI::App*) { return true; });
  };
  std::vector<const CLI::App*> commands = commands_of(app_.get());
  int at = 1;
  for (; at < argument_count; ++at) {
    const auto typed = std::find_if(commands.begin(), commands.end(), [&](const CLI::App* command) {
      return command->get_name() == arguments[at];
    });
    if (typed == commands.end()) break;
    commands = commands_of(*typed);
  }
  if (commands.empty() || at == argument_count || arguments[at][0] == '-') return {};
  std::vector<std::string> names;
  names.reserve(commands.size());
  for (const CLI::App* const command : commands) names.push_back(command->get_name());
  const std::string word = arguments[at];
  if (const std::string meant = find_similar(word, names); !meant.empty())
    return "Unknown command " + word + ": did you mean " + meant + "?";
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return "Unknown command " + word + ": expected one of " + list;
}

std::string Program::chosen() const {
  const CLI::App* const command = app_->get_subcommands().front();
  std::string name = command->get_name();
  for (const CLI::App* const part : command->get_subcommands()) name += " " + part->get_name();
  return name;
}

std::vector<std::string> Program::remaining() const {
  return app_->get_subcommands().front()->remaining(true);
}

}  // namespace traygauge
