#include "json_columns.h"

namespace posidonia
{
std::string base64(const std::vector<unsigned char>& bytes)
{
	static const char* const kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
	std::string text;
	text.reserve((bytes.size() + 2) / 3 * 4);
	for (size_t k = 0; k < bytes.size(); k += 3) {
		const size_t left = std::min<size_t>(3, bytes.size() - k);
		unsigned group = 0;
		for (size_t i = 0; i < 3; i++)
			group = group << 8 | (i < left ? bytes[k + i] : 0u);
		for (size_t i = 0; i < 4; i++)
			text += i <= left ? kDigits[group >> (18 - 6 * i) & 63] : '=';
	}
	return text;
}
}  // namespace posidonia
