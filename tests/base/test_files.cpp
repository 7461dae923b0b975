#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <temp_folder.h>

using namespace posidonia;
using namespace posidonia::testing;
namespace fs = std::filesystem;

TEST(Files, AWholeFileReplacesTheOldOne)
{
	CTempFolder folder;
	const std::string path = folder.write("a.txt", "old");
	writeFileWhole(path, [](std::ostream& out) { out << "new"; });
	EXPECT_EQ(fileBytes(path), "new");
	EXPECT_FALSE(fs::exists(path + ".part"));
}

TEST(Files, AnExceptionWhileWritingLeavesTheOldFileAndNoPart)
{
	CTempFolder folder;
	const std::string path = folder.write("a.txt", "old");
	const auto write = [](std::ostream& out) {
		out << "half";
		throw CError("x", "broke", "");
	};
	EXPECT_THROW(writeFileWhole(path, write), CError);
	EXPECT_EQ(fileBytes(path), "old");
	EXPECT_FALSE(fs::exists(path + ".part"));
}

TEST(Files, AStreamThatFailsIsAnErrorAndLeavesNothing)
{
	CTempFolder folder;
	const std::string path = folder / "a.txt";
	const auto fail = [](std::ostream& out) { out.setstate(std::ios::badbit); };
	EXPECT_HOLDS(errorOf<CError>([&] { writeFileWhole(path, fail); }), path);
	EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Files, AFolderInTheWayIsAnErrorAndLeavesNoPart)
{
	CTempFolder folder;
	fs::create_directories(folder / "a.txt/inside");
	const auto write = [](std::ostream& out) { out << "x"; };
	EXPECT_HOLDS(errorOf<CError>([&] { writeFileWhole(folder / "a.txt", write); }), "can't be replaced");
	EXPECT_FALSE(fs::exists(folder / "a.txt.part"));
}

TEST(Files, AMissingFolderIsNamed)
{
	CTempFolder folder;
	const auto write = [](std::ostream& out) { out << "x"; };
	EXPECT_HOLDS(errorOf<CError>([&] { writeFileWhole(folder / "no/a.txt", write); }), "no/a.txt");
}

TEST(Files, ReadingSaysWhatIsMissing)
{
	CTempFolder folder;
	EXPECT_EQ(readFileText(folder.write("a", "text\n")), "text\n");
	EXPECT_HOLDS(errorOf<CError>([&] { readFileText(folder / "no"); }), "no such file");
	EXPECT_HOLDS(errorOf<CError>([&] { requireFile(folder.path(), "way out"); }), "is a folder");
	EXPECT_HOLDS(errorOf<CError>([&] { requireFile(folder / "no", "way out"); }), "way out");
}

TEST(Files, FoldersAreMadeWithTheirParents)
{
	CTempFolder folder;
	makeFolder(folder / "a/b/c");
	makeFolder(folder / "a/b/c");
	EXPECT_TRUE(fs::is_directory(folder / "a/b/c"));
	folder.write("file", "");
	EXPECT_HOLDS(errorOf<CError>([&] { makeFolder(folder / "file/x"); }), "file/x");
}

TEST(Files, TheClosestNameIsOffered)
{
	EXPECT_EQ(didYouMean("roi_radus", {"seed", "roi_radius"}), "did you mean 'roi_radius'?");
	EXPECT_EQ(didYouMean("zzzzzz", {"seed", "roi"}), "known are: seed roi");
	EXPECT_EQ(didYouMean("x", {}), "nothing is known by such a name here");
}

TEST(Files, AnErrorSaysWhereWhatAndTheWayOut)
{
	EXPECT_STREQ(CError("f:3", "is bad", "mend it").what(), "f:3: is bad; mend it");
	EXPECT_STREQ(CError("f:3", "is bad", "").what(), "f:3: is bad");
}
