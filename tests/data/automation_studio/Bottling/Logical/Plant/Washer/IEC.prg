<?xml version="1.0" encoding="utf-8"?>
<?AutomationStudio Version=4.12.2.93 SP?>
<Program SubType="IEC" xmlns="http://br-automation.co.at/AS/Program">
  <Files>
    <File>Cyclic.sfc</File>
    <File>Actions.st</File>
    <File Private="true">Washer.var</File>
  </Files>
</Program>