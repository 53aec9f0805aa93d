#include "host/reading/expression_node.hpp"

#include "host/reading/source_position.hpp"

namespace eyeray::engine::reading {

std::string_view expression_of(const toml::node& node) {
  const auto* text = node.as_string();
  return text && is_expression(text->get()) ? std::string_view(text->get()) : std::string_view();
}

std::optional<std::vector<double>> evaluate(const toml::node& node, const Variables& variables,
                                            DiagnosticLog& log) {
  try {
    return evaluate(expression_of(node), variables);
  } catch (const ExpressionFault& fault) {
    SourcePosition at = start_of_text(node);
    at.column += at.line > 0 ? int(fault.offset) : 0;
    log.error(at, fault.what());
    return std::nullopt;
  }
}

}  // namespace eyeray::engine::reading
