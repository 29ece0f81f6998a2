#pragma once

/// CLI11 takes seconds to compile: who only needs an options' struct goes without.
namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI
