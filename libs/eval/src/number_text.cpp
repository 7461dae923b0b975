#include <posidonia/eval/number_text.h>

#include <array>
#include <charconv>

namespace posidonia
{
namespace
{
std::string withoutMinusZero(const std::string& text)
{
	const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
	return is_zero && text[0] == '-' ? text.substr(1) : text;
}

std::string toText(double x, std::chars_format format, int precision)
{
	std::array<char, 400> buffer;  // the largest double has 309 digits before the point
	const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x, format, precision).ptr;
	return withoutMinusZero(std::string(buffer.data(), end));
}
}  // namespace

std::string fixedText(double x, int decimals)
{
	return toText(x, std::chars_format::fixed, decimals);
}

std::string significantText(double x, int digits)
{
	return toText(x, std::chars_format::general, digits);
}
}  // namespace posidonia
