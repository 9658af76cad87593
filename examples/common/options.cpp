// SPDX-License-Identifier: BSL-1.0
#include "options.hpp"

#include <stickslip/io/new_file.hpp>

#include <boost/make_shared.hpp>
#include <boost/program_options.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <locale>
#include <sstream>
#include <string_view>
#include <system_error>

namespace examples {

namespace {

// What the user typed, as a sentence may quote it: on one line, without what terminals obey, and not for ever.
std::string shown(std::string text, std::size_t longest = 80) {
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  return text;
}

[[noreturn]] void refuse(const std::string& option, const std::string& value, const std::string& accepted) {
  throw BadOption("--" + option + ": \"" + shown(value) + "\" is not accepted; it takes " + accepted);
}

double number(const std::string& option, const std::string& text, double low, double high,
              const std::string& accepted) {
  const char *first = text.data(), *last = first + text.size();
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') ++first;  // from_chars takes no plus
  double value = 0;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last || !std::isfinite(value) || value < low || value > high)
    refuse(option, text, accepted);
  return value;
}

int integer(const std::string& option, const std::string& text, int low, int high, const std::string& accepted) {
  const double value = number(option, text, low, high, accepted);
  if (value != std::floor(value)) refuse(option, text, accepted);
  return static_cast<int>(value);
}

void known(const std::string& option, const std::string& name, const std::vector<std::string>& names) {
  for (const auto& n : names)
    if (n == name) return;
  refuse(option, name, "one of: " + joined(names));
}

std::string short_number(double x) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << x;
  return text.str();
}

[[noreturn]] void refuse_output(int error) {
  throw std::runtime_error("cannot write to the standard output: " + stickslip::io::detail::reason(error));
}

void flush_standard_output() {
  errno = 0;
  const bool sound = std::cout.flush().good() && std::ferror(stdout) == 0;
  if (std::fflush(stdout) != 0 || !sound) refuse_output(errno != 0 ? errno : EIO);
}

// A file that is opened would take the number of a standard stream that is closed, and get what is meant for that.
void occupy_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      (void)!open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);  // reading or writing fails as before
}

}  // namespace

void check_standard_output() {
  const int flags = fcntl(STDOUT_FILENO, F_GETFL);
  if (flags < 0) refuse_output(errno);
  if ((flags & O_ACCMODE) == O_RDONLY) refuse_output(EBADF);
}

void write_to_standard_output(std::string_view text) {
  flush_standard_output();
  if (const int error = stickslip::io::detail::write_all(STDOUT_FILENO, text.data(), text.size())) refuse_output(error);
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::optional<Options> parse(int argc, char** argv, const Program& program) {
  namespace po = boost::program_options;
  Options o;
  std::string mu, refine, steps, tolerance, lag_tolerance, step_tolerance, mesh_error_interval, wished, output,
      checkpoint, checkpoint_every, restart;
  const std::string about_friction = "friction law: " + joined(program.frictions),
                    about_solver = "linear solver: " + joined(program.solvers),
                    about_mu = "friction coefficient (default " + short_number(program.mu) + "; 0 with frictionless)",
                    about_tolerance = "of Newton's method, residual over force scale (default " +
                                      short_number(program.tolerance) + ")";
  po::options_description description("Options");
  const auto add = [&](const char* name, auto* target, const char* kind, const std::string& about) {
    description.add(
        boost::make_shared<po::option_description>(name, po::value(target)->value_name(kind), about.c_str()));
  };
  add("friction", &o.friction, "NAME", about_friction + " (default " + program.frictions[0] + ")");
  add("mu", &mu, "X", about_mu);
  add("solver", &o.solver, "NAME", about_solver + " (default " + program.solvers[0] + ")");
  add("refine", &refine, "N", "N times the elements in each direction (default 1)");
  add("steps", &steps, "auto|N", "automatic steps, or N equal ones (default auto)");
  add("tolerance", &tolerance, "X", about_tolerance);
  add("lag-tolerance", &lag_tolerance, "X", "estimated error by lag that automatic steps aim at (default none)");
  add("step-tolerance", &step_tolerance, "X", "the same of the error by the size of the steps (default none)");
  add("mesh-error-every", &mesh_error_interval, "N",
      "estimate the error of the mesh every N steps, 0 for never (default 10)");
  add("advise", &wished, "X", "say how an error of the force below X would be reached in the least time");
  add("output", &output, "DIR", "write VTU, CSV and pictures there");
  add("json", &o.json, "FILE", "write the results there, - for standard output");
  add("checkpoint", &checkpoint, "FILE",
      "keep the state there to restart from, written also on SIGTERM, SIGINT and SIGHUP");
  add("checkpoint-every", &checkpoint_every, "N", "write it every N steps (default 50)");
  add("restart", &restart, "FILE", "continue the run of the same options that kept this state");
  std::map<std::string, std::string> given;
  for (const Parameter& p : program.parameters) {
    const std::string kind = p.names.empty() ? "X" : "NAME",
                      standard = p.names.empty() ? short_number(p.value) : p.names[static_cast<std::size_t>(p.value)];
    const std::string choice = p.names.empty() ? "" : ": " + joined(p.names);
    add(p.name.c_str(), &given[p.name], kind.c_str(), p.about + choice + " (default " + standard + ")");
  }
  description.add_options()("quiet", po::bool_switch(&o.quiet), "no progress, no summary")(
      "list", po::bool_switch(&o.list), "names of what is instantiated")("help", "this text");
  po::variables_map values;
  try {
    const int exact = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
    po::store(po::command_line_parser(argc, argv).options(description).positional({}).style(exact).run(), values);
    po::notify(values);
  } catch (const po::error& e) {
    // Boost 1.74 puts what was typed where its sentence has %option% and the like, and never ends if that has them too.
    const bool percent = std::any_of(
        argv, argv + argc, [](const char* word) { return std::string_view(word).find('%') != std::string_view::npos; });
    throw BadOption((percent ? "an option is unknown, is there twice or lacks its value" : shown(e.what(), 200)) +
                    "; --help lists the options");
  }
  if (values.count("help")) {
    std::cout << program.name << ": " << program.title << "\n\n" << description;
    return std::nullopt;
  }
  if (!values.count("friction")) o.friction = program.frictions[0];
  if (!values.count("solver")) o.solver = program.solvers[0];
  known("friction", o.friction, program.frictions);
  known("solver", o.solver, program.solvers);
  const bool frictionless = o.friction == "frictionless";
  if (values.count("mu")) {
    o.mu = number("mu", mu, 0, 10, "a number from 0 to 10");
    if (frictionless && o.mu != 0) refuse("mu", mu, "nothing but 0 with --friction frictionless");
  } else {
    o.mu = frictionless ? 0 : program.mu;
  }
  if (values.count("refine")) o.refine = integer("refine", refine, 1, 1000, "a whole number from 1 to 1000");
  if (values.count("steps") && steps != "auto")
    o.steps = integer("steps", steps, 1, 10'000'000, "auto or a whole number from 1 to 10000000");
  o.tolerance = values.count("tolerance") ? number("tolerance", tolerance, 1e-14, 0.1, "a number from 1e-14 to 0.1")
                                          : program.tolerance;
  const auto wanted = [&](const char* name, const std::string& text) {
    return values.count(name) ? number(name, text, 0, 10, "a number from 0 to 10") : 0;
  };
  o.lag_tolerance = wanted("lag-tolerance", lag_tolerance);
  o.step_tolerance = wanted("step-tolerance", step_tolerance);
  if (values.count("mesh-error-every"))
    o.mesh_error_interval =
        integer("mesh-error-every", mesh_error_interval, 0, 1'000'000, "a whole number from 0 to 1000000");
  if (values.count("advise")) o.wished = number("advise", wished, 1e-9, 0.5, "a number from 1e-9 to 0.5");
  if (values.count("output") && output.empty()) refuse("output", output, "the name of a folder");
  o.output = output;
  if (values.count("checkpoint") && checkpoint.empty()) refuse("checkpoint", checkpoint, "the name of a file");
  if (values.count("restart") && restart.empty()) refuse("restart", restart, "the name of a file");
  if (values.count("checkpoint-every")) {
    o.checkpoint_every =
        integer("checkpoint-every", checkpoint_every, 1, 1'000'000, "a whole number from 1 to 1000000");
    if (checkpoint.empty()) refuse("checkpoint-every", checkpoint_every, "--checkpoint beside it");
  }
  o.checkpoint = checkpoint;
  o.restart = restart;
  for (const Parameter& p : program.parameters) {
    double& value = o.parameters[p.name] = p.value;
    if (!values.count(p.name)) continue;
    const std::string& text = given[p.name];
    if (p.names.empty()) {
      value =
          number(p.name, text, p.low, p.high, "a number from " + short_number(p.low) + " to " + short_number(p.high));
    } else {
      known(p.name, text, p.names);
      value = static_cast<double>(std::find(p.names.begin(), p.names.end(), text) - p.names.begin());
    }
  }
  return o;
}

int guarded(const std::string& name, const std::function<int()>& body) {
  occupy_standard_streams();
  // A pipe that nobody reads and a file beyond the limit are errors like others.
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
  int code = 0;
  try {
    code = body();
  } catch (const BadOption& e) {
    std::cerr << name << ": " << e.what() << '\n';
    code = 2;
  } catch (const std::exception& e) {
    std::cerr << name << ": " << e.what() << '\n';
    code = 1;
  }
  try {
    flush_standard_output();
  } catch (const std::exception& e) {
    std::cerr << name << ": " << e.what() << '\n';
    if (code == 0) code = output_missing;
  }
  return code;
}

}  // namespace examples
