#include <gtest/gtest.h>
#include <mrpt/io/CFileOutputStream.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>
#include <posidonia/base/error.h>
#include <posidonia/obs/rawlog_reader.h>
#include <posidonia/obs/rawlog_writer.h>
#include <temp_folder.h>

#include "sample_observations.h"

using namespace posidonia;
using namespace posidonia::testing;
namespace fs = std::filesystem;

namespace
{
/** Pressures [Pa] of all observations, in the order they come out. */
std::vector<double> pressures(CRawlogReader& reader)
{
	std::vector<double> values;
	double progress = 0;
	while (const auto observation = reader.next()) {
		values.push_back(dynamic_cast<CObservationPressure&>(*observation).pressure);
		EXPECT_GE(reader.progress(), progress);
		progress = reader.progress();
	}
	EXPECT_EQ(progress, 1);
	return values;
}

void writePressures(const std::string& path, const std::vector<double>& values)
{
	CRawlogWriter writer(path);
	for (size_t i = 0; i < values.size(); i++)
		writer.write(samplePressure(1.6e9 - 7.0 * double(i % 3), values[i]));
	writer.finish();
}

/** Uncompressed, so that tests can patch and cut it. */
std::string plainLog(size_t n)
{
	CTempFolder folder;
	{
		mrpt::io::CFileOutputStream file(folder / "plain.rawlog");
		auto archive = mrpt::serialization::archiveFrom(file);
		for (size_t i = 0; i < n; i++)
			archive << samplePressure(1.6e9, double(i));
	}
	return fileBytes(folder / "plain.rawlog");
}

mrpt::obs::CObservation::Ptr shared(double pascal)
{
	return std::make_shared<CObservationPressure>(samplePressure(1.6e9, pascal));
}
}  // namespace

TEST(Rawlog, ObservationsComeBackInTheFilesOrderNeverSorted)
{
	CTempFolder folder;
	const std::vector<double> values{5, 1, 4, 2, 3, 9, 8};
	writePressures(folder / "a.rawlog", values);  // its stamps jump back and forth
	CRawlogReader reader(folder / "a.rawlog");
	EXPECT_EQ(pressures(reader), values);
	EXPECT_EQ(reader.entry(), values.size());
	EXPECT_EQ(reader.damage(), "");
	EXPECT_EQ(reader.next(), nullptr);
}

TEST(Rawlog, FormatOneGivesTheFramesObservationsAndCountsActions)
{
	CTempFolder folder;
	{
		mrpt::io::CFileOutputStream file(folder / "a.rawlog");
		auto archive = mrpt::serialization::archiveFrom(file);
		for (int i = 0; i < 4; i++) {
			mrpt::obs::CSensoryFrame frame;
			frame.insert(shared(10 * i));
			frame.insert(shared(10 * i + 1));
			archive << mrpt::obs::CActionCollection() << frame;
		}
	}
	CRawlogReader reader(folder / "a.rawlog");
	EXPECT_EQ(pressures(reader), (std::vector<double>{0, 1, 10, 11, 20, 21, 30, 31}));
	EXPECT_EQ(reader.actionsLeftAside(), 4u);
	EXPECT_EQ(reader.damage(), "");
}

TEST(Rawlog, AWholeCRawlogObjectIsUnpacked)
{
	CTempFolder folder;
	mrpt::obs::CRawlog log;
	for (int i = 0; i < 3; i++)
		log.insert(shared(i));
	{
		mrpt::io::CFileOutputStream file(folder / "a.rawlog");
		mrpt::serialization::archiveFrom(file) << log;
	}
	CRawlogReader reader(folder / "a.rawlog");
	EXPECT_EQ(pressures(reader), (std::vector<double>{0, 1, 2}));
}

TEST(Rawlog, ACutAtAnyByteOfAPlainFileIsTold)
{
	CTempFolder folder;
	const std::string bytes = plainLog(3);
	const size_t size = bytes.size() / 3;
	for (size_t cut = size; cut <= bytes.size(); cut++) {
		CRawlogReader reader(folder.write("cut.rawlog", bytes.substr(0, cut)));
		EXPECT_EQ(pressures(reader).size(), cut / size) << "cut=" << cut;
		EXPECT_EQ(reader.damage().empty(), cut % size == 0) << "cut=" << cut;
	}
}

TEST(Rawlog, ACutOfACompressedFileIsToldAlsoInItsTrailer)
{
	CTempFolder folder;
	std::vector<double> values;
	for (int i = 0; i < 500; i++)
		values.push_back(std::sin(i) * 1e5);
	writePressures(folder / "a.rawlog", values);
	const std::string bytes = fileBytes(folder / "a.rawlog");
	for (const size_t cut :
		 {bytes.size() - 1, bytes.size() - 8, bytes.size() - 9, bytes.size() / 2, bytes.size() / 4})
	{
		CRawlogReader reader(folder.write("cut.rawlog", bytes.substr(0, cut)));
		const auto read = pressures(reader);
		ASSERT_GT(read.size(), 20u) << "cut=" << cut;
		ASSERT_LE(read.size(), values.size()) << "cut=" << cut;
		EXPECT_TRUE(std::equal(read.begin(), read.end(), values.begin())) << "cut=" << cut;
		EXPECT_HOLDS(reader.damage(), "damaged after entry " + std::to_string(read.size())) << "cut=" << cut;
	}
}

TEST(Rawlog, AWrongChecksumIsTold)
{
	CTempFolder folder;
	std::vector<double> values;
	for (int i = 0; i < 1000; i++)
		values.push_back(std::sin(i) * 1e5);
	writePressures(folder / "a.rawlog", values);
	std::string bytes = fileBytes(folder / "a.rawlog");
	bytes[bytes.size() - 6] = static_cast<char>(bytes[bytes.size() - 6] ^ 1);
	CRawlogReader reader(folder.write("b.rawlog", bytes));
	while (reader.next()) {
	}
	EXPECT_HOLDS(reader.damage(), "cut off or corrupt");
}

TEST(Rawlog, RubbishBehindTheLastObjectIsTold)
{
	CTempFolder folder;
	CRawlogReader reader(folder.write("a.rawlog", plainLog(2) + "rubbish"));
	EXPECT_EQ(pressures(reader).size(), 2u);
	EXPECT_HOLDS(reader.damage(), "damaged after entry 2");
}

TEST(Rawlog, AnUnknownClassIsNamed)
{
	CTempFolder folder;
	std::string bytes = plainLog(3);
	bytes.replace(bytes.rfind("CObservationPressure"), 20, "CObservationSonarXYZ");
	CRawlogReader reader(folder.write("a.rawlog", bytes));
	EXPECT_TRUE(reader.next());
	EXPECT_TRUE(reader.next());
	const std::string problem = errorOf<CError>([&] { reader.next(); });
	EXPECT_HOLDS(problem, "a.rawlog: entry 2: class 'posidonia::CObservationSonarXYZ' is not known");
}

TEST(Rawlog, WhatIsNoRawlogIsRefused)
{
	CTempFolder folder;
	const auto problemOf = [&](const std::string& bytes) {
		return errorOf<CError>([&] { CRawlogReader(folder.write("x.rawlog", bytes)); });
	};
	EXPECT_HOLDS(problemOf(""), "x.rawlog: holds no observation");
	EXPECT_HOLDS(problemOf("timestamp,x,y\n1,2,3\n"), "x.rawlog: is no rawlog");
	EXPECT_HOLDS(problemOf(std::string(5000, 'h')), "x.rawlog: is no rawlog");
	std::string prose;
	for (int i = 0; i < 200; i++)
		prose += "[Section]\nkey = value of a long text file\n";
	EXPECT_HOLDS(problemOf(prose), "x.rawlog: is no rawlog");
	EXPECT_HOLDS(problemOf(plainLog(1).substr(0, 60)), "x.rawlog: is no rawlog, or is cut off");
}

TEST(Rawlog, AMissingFileAndAFolderAreRefused)
{
	CTempFolder folder;
	EXPECT_HOLDS(errorOf<CError>([&] { CRawlogReader(folder / "no.rawlog"); }), "no.rawlog: no such file");
	EXPECT_HOLDS(errorOf<CError>([&] { CRawlogReader(folder.path()); }), "is a folder");
}

TEST(Rawlog, TheWriterLeavesAllOrNothing)
{
	CTempFolder folder;
	const std::string path = folder.write("a.rawlog", "old");
	{
		CRawlogWriter writer(path);
		writer.write(samplePressure(1));
		EXPECT_EQ(fileBytes(path), "old");
	}
	EXPECT_EQ(fileBytes(path), "old");
	EXPECT_FALSE(fs::exists(path + ".part"));
	writePressures(path, {1, 2});
	CRawlogReader reader(path);
	EXPECT_EQ(pressures(reader).size(), 2u);
	EXPECT_FALSE(fs::exists(path + ".part"));
}

TEST(Rawlog, TheWriterNamesWhatItCantWrite)
{
	CTempFolder folder;
	EXPECT_HOLDS(errorOf<CError>([&] { CRawlogWriter(folder / "no/a.rawlog"); }), "no/a.rawlog");
	fs::create_directories(folder / "b.rawlog/x");
	EXPECT_HOLDS(errorOf<CError>([&] { writePressures(folder / "b.rawlog", {1}); }), "can't be replaced");
	EXPECT_FALSE(fs::exists(folder / "b.rawlog.part"));
}

TEST(Rawlog, TheSameObservationsGiveTheSameBytes)
{
	CTempFolder folder;
	writePressures(folder / "a.rawlog", {1, 2, 3});
	writePressures(folder / "b.rawlog", {1, 2, 3});
	EXPECT_EQ(fileBytes(folder / "a.rawlog"), fileBytes(folder / "b.rawlog"));
}
