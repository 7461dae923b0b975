#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace posidonia::testing
{
/** An empty folder of the running test, removed at the end. */
class CTempFolder
{
   public:
	CTempFolder()
	{
		const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
		m_path =
			(std::filesystem::temp_directory_path() / (std::string("posidonia-") + test->test_suite_name() +
													   "-" + test->name() + "-" + std::to_string(getpid())))
				.string();
		for (char& c : m_path)
			if (c == ' ') c = '_';
		std::filesystem::remove_all(m_path);
		std::filesystem::create_directories(m_path);
	}
	~CTempFolder()
	{
		std::error_code ignored;
		std::filesystem::remove_all(m_path, ignored);
	}
	CTempFolder(const CTempFolder&) = delete;
	CTempFolder& operator=(const CTempFolder&) = delete;

	const std::string& path() const { return m_path; }
	std::string operator/(const std::string& name) const { return m_path + "/" + name; }

	/** Writes a file (its folders too) and returns its path. */
	std::string write(const std::string& name, const std::string& text) const
	{
		const std::string path = m_path + "/" + name;
		std::filesystem::create_directories(std::filesystem::path(path).parent_path());
		std::ofstream(path, std::ios::binary) << text;
		return path;
	}

   private:
	std::string m_path;
};

inline std::string fileBytes(const std::string& path)
{
	std::ifstream in(path, std::ios::binary);
	std::stringstream text;
	text << in.rdbuf();
	return text.str();
}

/** what() of the ERROR that f throws; "" when it throws nothing. */
template <class ERROR, class F>
std::string errorOf(F&& f)
{
	try {
		f();
	}
	catch (const ERROR& error) {
		return error.what();
	}
	return {};
}
}  // namespace posidonia::testing

/** That `text` holds `part`. */
#define EXPECT_HOLDS(text, part) \
	EXPECT_NE(std::string(text).find(part), std::string::npos) << "'" << part << "' not in:\n" << (text)
