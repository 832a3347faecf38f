#include "firmware/simulate/simulate_command.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "firmware/base/build_info.hpp"
#include "firmware/base/exit_status.hpp"
#include "firmware/base/text.hpp"
#include "firmware/card/card_drawing.hpp"
#include "firmware/command/program.hpp"
#include "firmware/evaluate/evaluation_files.hpp"
#include "firmware/evaluate/progress.hpp"
#include "firmware/simulate/plan_scenes.hpp"
#include "simulator/capture/input_error.hpp"
#include "simulator/capture/png_writer.hpp"
#include "simulator/scenes/capture_writer.hpp"
#include "simulator/scenes/scene_file.hpp"
#include "simulator/scenes/scene_sets.hpp"
#include "simulator/scenes/scene_views.hpp"

namespace traygauge {
namespace {

struct RenderOptions {
  std::string what;
  std::string out;
  std::string only;
  std::uint64_t seed = 1;
  int jobs = 0;
  int samples = RenderSettings().samples;
  int pairs = 0;  // of each scene; 0: all
  bool is_reduced = false;
  bool is_quick = false;
  bool is_bare = false;
  std::string config;  // of a plan's dish
  CaptureExtras extras;
};

bool is_set(const std::string& name) {
  const auto sets = scene_sets();
  return std::any_of(sets.begin(), sets.end(), [&](const SceneSet& set) { return set.name == name; });
}

SetSize size_of(const RenderOptions& options) {
  if (options.is_quick) return SetSize::quick;
  return options.is_reduced ? SetSize::reduced : SetSize::full;
}

std::vector<SceneDescription> find_scenes(const RenderOptions& options) {
  std::vector<SceneDescription> scenes;
  if (is_set(options.what)) {
    scenes = make_scenes(options.what, options.seed, size_of(options));
  } else if (std::filesystem::path(options.what).extension() == ".toml") {
    if (options.is_quick)
      throw UsageError("--quick: expected a set (see traygauge-simulate list), found the scene " +
                       options.what + ", whose own camera says how large its pictures are");
    scenes.push_back(read_scene_file(options.what));
  } else {
    throw UsageError(options.what +
                     ": expected the name of a set (see traygauge-simulate list) or a scene as .toml");
  }
  if (!options.only.empty()) {
    std::erase_if(scenes, [&](const SceneDescription& scene) { return scene.name != options.only; });
    if (scenes.empty())
      throw UsageError("--only " + options.only + ": " + options.what + " has no scene of that name");
  }
  if (options.is_bare) {
    for (SceneDescription& scene : scenes) scene.foods.clear();
  }
  if (options.pairs > 0) {
    for (SceneDescription& scene : scenes) keep_first_pairs(scene, static_cast<std::size_t>(options.pairs));
  }
  return scenes;
}

int render_scenes(std::vector<SceneDescription> scenes, const RenderOptions& options, std::ostream& out,
                  std::ostream& error) {
  RenderSettings settings = options.is_quick ? quick_settings() : RenderSettings();
  settings.samples = options.samples;
  settings.threads = options.jobs;
  const std::filesystem::path folder = options.out;
  const std::size_t all = scenes.size();
  std::erase_if(scenes, [&](const SceneDescription& scene) {
    const CaptureState state = state_of_capture(folder / scene.name, scene, settings, options.extras);
    if (state == CaptureState::stale)
      error << scene.name << ": made from another description or by another program; rendered again\n";
    if (state == CaptureState::complete) update_description(folder / scene.name, scene);
    return state == CaptureState::complete;
  });
  std::size_t pictures = 0;
  for (const SceneDescription& scene : scenes) pictures += scene.views.size();

  std::size_t done = 0;
  {
    Progress progress(error, isatty(STDERR_FILENO) == 1, "pictures");
    for (const SceneDescription& scene : scenes) {
      const auto views = static_cast<double>(scene.views.size());
      const auto show = [&](double share) {
        progress.show(done + static_cast<std::size_t>(std::floor(share * views)), pictures);
      };
      render_capture(scene, folder / scene.name, settings, show, options.extras);
      done += scene.views.size();
    }
  }
  out << folder.string() << ": " << scenes.size() << " captures rendered";
  if (all > scenes.size()) out << ", " << all - scenes.size() << " were complete already";
  out << "\n";
  return kExitMeasured;
}

int run_plan(const RenderOptions& options, std::ostream& out, std::ostream& error) {
  const VerifyPlan plan = read_verify_plan(options.what);
  const std::filesystem::path folder = options.out;
  create_folder(folder);
  const std::filesystem::path card = folder / "card.png";
  write_png(card, card_picture(1).frame());
  return render_scenes(scenes_of_plan(plan, {options.seed, options.is_reduced, options.config, card}),
                       options, out, error);
}

int run_list(std::ostream& out) {
  for (const SceneSet& set : scene_sets()) out << pad_right(std::string(set.name), 12) << set.what << "\n";
  return kExitMeasured;
}

// Of whatever is rendered; returns --reduced.
CommandOption add_render_options(Command& command, RenderOptions& options, const std::string& seed,
                                 const std::string& reduced) {
  command.add_option("--out", options.out, "folder of the captures; complete ones in it are kept").required();
  command.add_option("--seed", options.seed, seed);
  command.add_option("--jobs", options.jobs, "threads; 0: one a core").range(0, 256);
  command.add_option("--samples", options.samples, "rays a pixel").range(8, 4096);
  return command.add_flag("--reduced", options.is_reduced, reduced);
}

void add_render(Program& program, RenderOptions& options) {
  Command command = program.add_command("render", "Render a set, or one scene, into capture folders.");
  command.add_option("what", options.what, "a set (see list) or a scene as .toml").required();
  const CommandOption reduced = add_render_options(command, options, "of the set's scenes",
                                                   "a few scenes of the set, in small pictures");
  command.add_flag("--quick", options.is_quick, "all scenes of the set in pictures of 320 x 240, to train on")
      .excludes(reduced);
  command.add_flag("--bare", options.is_bare, "the same dishes and views without food, to train on");
  command.add_option("--only", options.only, "the one scene of this name");
  command.add_option("--pairs", options.pairs, "of each scene, the first N; 0: all").range(0, 1000);
  command.add_flag("--kinds", options.extras.has_kinds,
                   "also write kinds_N.png: glaze, rim, cutlery and more, to train on");
}

void add_plan(Program& program, RenderOptions& options) {
  Command command = program.add_command("verify", "Render each step of a plan of traygauge verify.");
  command.add_option("plan", options.what, "the plan; its bodies have to be folded ones").required();
  add_render_options(command, options, "of how exactly a person lays things",
                     "pictures of a quarter of the size");
  command.add_option("--config", options.config, "folder with dishes/").environment("TRAYGAUGE_CONFIG");
}

}  // namespace

int run_simulate(int argument_count, const char* const* arguments, std::ostream& out, std::ostream& error) {
  Program program("Renders scenes of trays into captures with exact truth.", "traygauge-simulate");
  program.add_version(describe_build("traygauge-simulate"));
  RenderOptions options;
  add_render(program, options);
  add_plan(program, options);
  program.add_command("list", "The sets of scenes.");
  const auto run = [&] {
    if (program.chosen() == "list") return run_list(out);
    if (program.chosen() == "verify") return run_plan(options, out, error);
    return render_scenes(find_scenes(options), options, out, error);
  };
  return program.run(argument_count, arguments, run, out, error);
}

}  // namespace traygauge
