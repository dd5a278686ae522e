// How all commands take the text of their options.
#pragma once

namespace CLI {
class App;
}

namespace diptych::core::app {

/// For every option of every command: an empty text is refused, because it would be taken for an absent option, and
/// whole numbers are decimal, because CLI11 takes 0010 for octal.
void take_text_as_typed(CLI::App& program);

}  // namespace diptych::core::app
