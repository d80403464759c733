#include "service/cli/command_line.h"

#include <utility>

#include <CLI/CLI.hpp>

namespace farhorizon {

namespace {

template <typename Value>
CLI::Option* AddValue(CLI::App& app, const Argument& argument, Value& value) {
  return app.add_option(argument.names, value, argument.help)
      ->required(argument.required)
      ->type_name(argument.type);
}

template <typename Value>
CLI::Option* AddTaker(CLI::App& app, const Argument& argument,
                      const std::function<void(const Value&)>& take) {
  return app.add_option_function<Value>(argument.names, take, argument.help)
      ->required(argument.required)
      ->type_name(argument.type);
}

}  // namespace

Command Command::AddCommand(const char* name, const char* help) {
  app_->require_subcommand(1);
  return Command(*app_->add_subcommand(name, help));
}

void Command::Add(const Argument& argument, std::string& value) {
  AddValue(*app_, argument, value);
}

void Command::Add(const Argument& argument, const std::function<void(const std::string&)>& take) {
  AddTaker<std::string>(*app_, argument, take);
}

void Command::Add(const Argument& argument, double& value) { AddValue(*app_, argument, value); }

void Command::Add(const Argument& argument, std::optional<double>& value) {
  AddValue(*app_, argument, value);
}

void Command::Add(const Argument& argument, double& value, double least, double greatest) {
  AddValue(*app_, argument, value)->check(CLI::Range(least, greatest));
}

void Command::Add(const Argument& argument, int& value, int least, int greatest) {
  AddValue(*app_, argument, value)->check(CLI::Range(least, greatest));
}

void Command::AddChoice(const Argument& argument, std::string& value,
                        std::vector<std::string> choices) {
  AddValue(*app_, argument, value)->check(CLI::IsMember(std::move(choices)).description(""));
}

void Command::AddList(const Argument& argument,
                      const std::function<void(const std::vector<std::string>&)>& take) {
  CLI::Option* const option = AddTaker<std::vector<std::string>>(*app_, argument, take);
  // One value after each flag: the next word may be positional.
  if (argument.names.front() == '-') option->allow_extra_args(false);
}

void Command::AddSwitch(const char* names, const char* help, bool& value) {
  app_->add_flag(names, value, help);
}

void Command::AddSwitch(const char* names, const char* help, std::function<void()> take) {
  app_->add_flag_callback(names, std::move(take), help);
}

void Command::SetFooter(const std::string& text) { app_->footer(text); }

void Command::Hide() { app_->group(""); }

void Command::Select(SelectedCommand& selected, std::function<int()> run) {
  app_->callback([&selected, run = std::move(run)] { selected = run; });
}

}  // namespace farhorizon
