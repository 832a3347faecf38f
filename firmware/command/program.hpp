// The command line of our programs: commands, their options, and errors told once on one line.
//
// The parser behind it is CLI11, which takes seven seconds to compile wherever it is included: program.cpp is
// the only one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): CLI11's own
class App;
class Option;
}  // namespace CLI

namespace traygauge {

// An option that was added, to say more of it. Refers to its program.
class CommandOption {
 public:
  explicit CommandOption(CLI::Option& option) : option_(&option) {}

  CommandOption& required();
  CommandOption& range(int min, int max);  // inclusive
  CommandOption& range(double min, double max);
  CommandOption& positive();                            // more than 0
  CommandOption& environment(const std::string& name);  // the variable that counts where nothing is typed
  CommandOption& several();                             // may be typed again, and takes all
  CommandOption& show_default();                        // the value that it has now, in the help
  CommandOption& excludes(const CommandOption& other);

 private:
  CLI::Option* option_;
};

// A command, or the whole program. Refers to its program. Values outlive it; parsing fills them where they
// are typed. A name without dashes is that of an argument.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(&app) {}

  CommandOption add_option(const std::string& name, std::string& value, const std::string& text);
  CommandOption add_option(const std::string& name, std::filesystem::path& value, const std::string& text);
  CommandOption add_option(const std::string& name, std::vector<std::string>& value, const std::string& text);
  CommandOption add_option(const std::string& name, int& value, const std::string& text);
  CommandOption add_option(const std::string& name, std::uint64_t& value, const std::string& text);
  CommandOption add_option(const std::string& name, double& value, const std::string& text);
  CommandOption add_flag(const std::string& name, bool& value, const std::string& text);
  // `action` is called where the flag is typed.
  CommandOption add_action(const std::string& name, const std::function<void()>& action,
                           const std::string& text);

  // A command of this one, which then needs one of them.
  Command add_command(const std::string& name, const std::string& text);
  // Takes nothing itself, not even --help: all that follows is Program::remaining().
  void take_nothing();

 private:
  CLI::App* app_;
};

// What is typed after its name: exactly one command and that one's options.
class Program {
 public:
  // `name` is how errors begin.
  Program(const std::string& text, const std::string& name);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program();

  void add_version(const std::string& version);  // --version
  Command add_command(const std::string& name, const std::string& text);
  // For options of the whole program. They stand before the command; after it, too, if this is called before
  // commands are added.
  Command whole();
  void take_options_after_commands();

  // `--describe` alone, which no help tells, prints commands and options for firmware/manual, which makes the
  // manual page and the shell's completion of them. Else:
  // Parses the arguments, calls `action` and returns the exit status, which is the action's. Exceptions of
  // either, and output that could not be written, become a line that begins with the name, and status 2.
  int run(int argument_count, const char* const* arguments, const std::function<int()>& action,
          std::ostream& out, std::ostream& error);

  // For the action: the command that was typed, as "config check" where it is one of another's, and what it
  // did not take.
  std::string chosen() const;
  std::vector<std::string> remaining() const;

 private:
  std::string name_unknown_command(int argument_count, const char* const* arguments) const;

  std::unique_ptr<CLI::App> app_;
};

}  // namespace traygauge
