# Below pictures of what the studio does, the studio in that mode; live.js gives it the shapes of the page. Before links.sed.
/images\/studio\.png/a @htmlonly <iframe src="studio.html#cage" title="The studio: a cage to drag" loading="lazy" style="width:100%;height:760px;border:0"></iframe> @endhtmlonly
/images\/fish-pair\.png/a @htmlonly <iframe src="studio.html#fish" title="The studio: the fish of this page, in its cage" loading="lazy" style="width:100%;height:760px;border:0"></iframe> @endhtmlonly
/images\/hero\.gif/a @htmlonly <iframe src="studio.html#fish" title="The studio: the fish of this page, in its cage" loading="lazy" style="width:100%;height:760px;border:0"></iframe> @endhtmlonly
/images\/eye\.png/a @htmlonly <iframe src="studio.html#eye" title="The studio: the eye of this page, with its contours" loading="lazy" style="width:100%;height:760px;border:0"></iframe> @endhtmlonly
/images\/character\.png/a @htmlonly <iframe src="studio.html#character" title="The studio: the character of this page, with its bones" loading="lazy" style="width:100%;height:760px;border:0"></iframe> @endhtmlonly
/images\/county\.png/a @htmlonly <iframe src="studio.html#county" title="The studio: the county of this page" loading="lazy" style="width:100%;height:760px;border:0"></iframe> @endhtmlonly
/images\/island\.png/a @htmlonly <iframe src="studio.html#island" title="The studio: the island of this page" loading="lazy" style="width:100%;height:760px;border:0"></iframe> @endhtmlonly
/images\/star-weight\.png/a @htmlonly <iframe src="studio.html#star" title="The studio: the star of this page, with its handles" loading="lazy" style="width:100%;height:760px;border:0"></iframe> @endhtmlonly
/images\/pins\.png/a @htmlonly <iframe src="studio.html#pins" title="The studio: the fish of this page, with its handles" loading="lazy" style="width:100%;height:760px;border:0"></iframe> @endhtmlonly
/\.\.\/images\/stages\.png/a @htmlonly <iframe src="studio.html#tripus" title="The studio: the papers' steps on the shape of this page" loading="lazy" style="width:100%;height:760px;border:0"></iframe> @endhtmlonly
/images\/bar\.png/a @htmlonly <iframe src="studio.html#space" title="The studio: a bar to bend" loading="lazy" style="width:100%;height:760px;border:0"></iframe> @endhtmlonly
/^<!-- live: parish -->/a @htmlonly <iframe src="studio.html#parish" title="The studio: the parish of this page" loading="lazy" style="width:100%;height:760px;border:0"></iframe> @endhtmlonly
/^<!-- live: square -->/a @htmlonly <iframe src="studio.html#square" title="The studio: the square of this page" loading="lazy" style="width:100%;height:760px;border:0"></iframe> @endhtmlonly
/^<!-- live: tripus -->/a @htmlonly <iframe src="studio.html#tripus" title="The studio: the papers' steps on the shape with three legs" loading="lazy" style="width:100%;height:760px;border:0"></iframe> @endhtmlonly
